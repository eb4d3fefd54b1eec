#include "planner/sets/finger_sequence.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "planner/planning/switch_sequence.h"

namespace regrasp {

namespace {

bool IsEmpty(const Switch& step) { return step.place.empty() && step.release.empty(); }

bool Holds(const FingerGrasp& holding, const Contact& contact) {
  return std::ranges::any_of(holding, [&](const FingerContact& finger) {
    return finger.contact.p == contact.p && finger.contact.n == contact.n;
  });
}

}  // namespace

FingerGrasp FollowTo(const FingerGrasp& holding, const Grasp& next) {
  assert(holding.size() == next.size());
  Grasp left = next;
  FingerGrasp after = holding;
  FingerContact* astray = nullptr;
  for (FingerContact& finger : after) {
    const auto same = std::ranges::find(left, finger.contact.face, &Contact::face);
    if (same == left.end()) {
      assert(astray == nullptr);
      astray = &finger;
      continue;
    }
    finger.contact = *same;
    left.erase(same);
  }
  if (astray != nullptr) astray->contact = left.front();
  return after;
}

FingerSequence::FingerSequence(const Grasp& start, int fingers)
    : candidate_(StartOf(start)),
      fingers_(fingers),
      holding_(candidate_.initial),
      held_before_(candidate_.initial) {}

void FingerSequence::SwitchTo(const Grasp& after, std::optional<VertexPair> chosen_for,
                              std::optional<double> region) {
  Switch step = MakeSwitch(holding_, after, fingers_);
  if (IsEmpty(step)) return;
  for (FingerContact& placed : step.place) placed.region = region;
  if (!region && CanJoinLastSwitch(after)) {
    step = MakeSwitch(held_before_, after, fingers_);
    holding_ = held_before_;
    candidate_.steps.pop_back();
    candidate_.rests.pop_back();
  }
  AddStep(std::move(step), chosen_for);
}

void FingerSequence::AlignAlong(const std::vector<Grasp>& waypoints,
                                std::optional<VertexPair> chosen_for) {
  Align align = {{holding_}};
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    align.waypoints.push_back(FollowTo(align.waypoints.back(), waypoints[i]));
  }
  AddStep(std::move(align), chosen_for);
}

bool FingerSequence::CanJoinLastSwitch(const Grasp& after) const {
  if (candidate_.steps.empty() || !std::holds_alternative<Switch>(candidate_.steps.back())) {
    return false;
  }
  const auto placed = std::ranges::count_if(
      after, [&](const Contact& contact) { return !Holds(held_before_, contact); });
  return std::ssize(held_before_) + placed <= fingers_ &&
         !IsEmpty(MakeSwitch(held_before_, after, fingers_));
}

void FingerSequence::AddStep(Step step, std::optional<VertexPair> chosen_for) {
  held_before_ = holding_;
  holding_ = GraspAfter(holding_, step);
  candidate_.rests.push_back({ContactsOf(holding_), chosen_for});
  candidate_.steps.push_back(std::move(step));
}

}  // namespace regrasp
