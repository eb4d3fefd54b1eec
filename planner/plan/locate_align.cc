#include "planner/plan/locate_align.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "planner/plan/locate.h"
#include "planner/plan/motion_fault.h"

namespace regrasp::plan {

namespace {

/// No more places of a contact are looked at: where so many faces meet in one plane, almost, the
/// nearest normals are as good as any.
constexpr std::size_t kMostChoices = 16;

/// Points this near each other, over the diameter, are one up to rounding.
constexpr double kRounding = 1e-12;

/// One place of a contact, and the best path of the finger to it.
struct Choice {
  grasp::Contact place;
  int faults = 0;     ///< on the best path
  int ranks = 0;      ///< places before the chosen ones in their lists, summed
  int previous = -1;  ///< choice at the waypoint before
};

using Choices = std::vector<Choice>;

Choices FindChoices(const object::Object& object, const grasp::Contact& contact) {
  Choices choices;
  for (const grasp::Contact& place : LocateEverywhere(object, contact)) {
    if (choices.size() == kMostChoices) break;
    choices.push_back({place, 0, static_cast<int>(choices.size())});
  }
  if (choices.empty()) choices.push_back({LocateContact(object, contact).contact});
  return choices;
}

bool IsFault(const object::Object& object, const grasp::Contact& from, const grasp::Contact& to) {
  return from.face.valid() && to.face.valid() && FindMotionFault(object, from, to).has_value();
}

bool IsBetter(const Choice& a, const Choice& b) {
  return a.faults != b.faults ? a.faults < b.faults : a.ranks < b.ranks;
}

/// Extends the best paths to the waypoint before by one motion.
void Extend(const object::Object& object, const Choices& before, Choices& choices) {
  for (Choice& choice : choices) {
    Choice best;
    best.faults = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < before.size(); ++i) {
      Choice path = choice;
      path.faults = before[i].faults + IsFault(object, before[i].place, choice.place);
      path.ranks = before[i].ranks + choice.ranks;
      path.previous = static_cast<int>(i);
      if (IsBetter(path, best)) best = path;
    }
    choice = best;
  }
}

/// A point of an edge has its projections on both faces, which rounding may keep apart: a finger
/// that turns there would move by next to nothing, and nothing could be proved of that. It keeps
/// the first one.
void KeepTurningPoints(const object::Object& object, const std::vector<grasp::Contact*>& chain) {
  for (std::size_t j = 1; j < chain.size(); ++j) {
    const grasp::Contact& before = *chain[j - 1];
    if (!before.face.valid() || !chain[j]->face.valid() || before.face == chain[j]->face) continue;
    if ((before.p - chain[j]->p).norm() <= kRounding * object.diameter()) chain[j]->p = before.p;
  }
}

/// The contacts of one finger, in the order of the waypoints.
void LocateChain(const object::Object& object, const std::vector<grasp::Contact*>& chain) {
  std::vector<Choices> choices;
  for (const grasp::Contact* contact : chain) {
    choices.push_back(FindChoices(object, *contact));
    if (choices.size() > 1) Extend(object, choices[choices.size() - 2], choices.back());
  }
  int chosen =
      static_cast<int>(std::ranges::min_element(choices.back(), IsBetter) - choices.back().begin());
  for (std::size_t j = chain.size(); j-- > 0;) {
    *chain[j] = choices[j][chosen].place;
    chosen = choices[j][chosen].previous;
  }
  KeepTurningPoints(object, chain);
}

}  // namespace

void LocateAlign(const object::Object& object, Align& align) {
  // A finger that a waypoint names twice, by mistake, is two chains.
  std::map<std::pair<FingerIndex, int>, std::vector<grasp::Contact*>> chains;
  for (FingerGrasp& waypoint : align.waypoints) {
    std::map<FingerIndex, int> named;
    for (FingerContact& held : waypoint) {
      chains[{held.finger, named[held.finger]++}].push_back(&held.contact);
    }
  }
  for (const auto& [finger, chain] : chains) LocateChain(object, chain);
}

}  // namespace regrasp::plan
