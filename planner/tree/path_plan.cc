#include "planner/tree/path_plan.h"

#include <algorithm>
#include <cassert>

#include "planner/planning/switch_sequence.h"

namespace regrasp::tree {

namespace {

bool SameContact(const Contact& a, const Contact& b) {
  return a.face == b.face && a.p == b.p && a.n == b.n;
}

/// The waypoints of an align, each finger with its own contacts.
std::vector<FingerGrasp> WaypointsFor(const FingerGrasp& holding, const FaceAlign& align,
                                      const SearchSpace& space) {
  const std::vector<Grasp> grasps = WaypointsOf(align, space);
  std::vector<FingerGrasp> waypoints(grasps.size(), holding);
  for (std::size_t f = 0; f < holding.size(); ++f) {
    const auto same = std::find_if(
        grasps.front().begin(), grasps.front().end(),
        [&](const Contact& contact) { return SameContact(holding[f].contact, contact); });
    assert(same != grasps.front().end());
    const auto place = same - grasps.front().begin();
    for (std::size_t w = 0; w < grasps.size(); ++w) waypoints[w][f].contact = grasps[w][place];
  }
  return waypoints;
}

void AddAlign(const std::vector<FingerGrasp>& waypoints, CandidateSequence& candidate) {
  auto* last = candidate.steps.empty() ? nullptr : std::get_if<Align>(&candidate.steps.back());
  const Grasp after = ContactsOf(waypoints.back());
  if (last != nullptr) {
    last->waypoints.insert(last->waypoints.end(), waypoints.begin() + 1, waypoints.end());
    candidate.rests.back().grasp = after;
    return;
  }
  candidate.steps.emplace_back(Align{waypoints});
  candidate.rests.push_back({after, std::nullopt});
}

/// Of each contact of `from` that is not in `to`: from there to the nearest one that is new.
double PathOfSwitch(const ContactSet& from, const ContactSet& to, const SearchSpace& space) {
  double way = 0;
  for (const int placed : to) {
    if (from.Has(placed)) continue;
    double nearest = -1;
    for (const int left : from) {
      if (to.Has(left)) continue;
      const double distance = (space.contact(left).p - space.contact(placed).p).norm();
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    way += std::max(nearest, 0.0);
  }
  return way;
}

}  // namespace

CandidateSequence MakeCandidate(const GraspPath& path, const Grasp& start,
                                const SearchSpace& space) {
  CandidateSequence candidate = StartOf(start);
  FingerGrasp holding = candidate.initial;
  for (const PathStep& step : path.steps) {
    if (step.align) {
      const std::vector<FingerGrasp> waypoints = WaypointsFor(holding, *step.align, space);
      AddAlign(waypoints, candidate);
      holding = waypoints.back();
      continue;
    }
    const Switch change = MakeSwitch(holding, space.GraspOf(step.to), space.fingers());
    holding = GraspAfter(holding, change);
    candidate.steps.emplace_back(change);
    candidate.rests.push_back({ContactsOf(holding), std::nullopt});
  }
  return candidate;
}

double TravelOf(const GraspPath& path, const SearchSpace& space) {
  double way = 0;
  const ContactSet* before = &path.start;
  for (const PathStep& step : path.steps) {
    way += step.align ? TravelOf(*step.align, space) : PathOfSwitch(*before, step.to, space);
    before = &step.to;
  }
  return way;
}

}  // namespace regrasp::tree
