#include "planner/sets/sequence_builder.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "planner/planning/candidate_sequence.h"

namespace regrasp::sets {

namespace {

bool IsEmpty(const plan::Switch& step) { return step.place.empty() && step.release.empty(); }

bool Holds(const plan::FingerGrasp& holding, const grasp::Contact& contact) {
  return std::ranges::any_of(holding, [&](const plan::FingerContact& finger) {
    return finger.contact.p == contact.p && finger.contact.n == contact.n;
  });
}

}  // namespace

plan::FingerGrasp FollowTo(const plan::FingerGrasp& holding, const grasp::Grasp& next) {
  assert(holding.size() == next.size());
  grasp::Grasp left = next;
  plan::FingerGrasp after = holding;
  plan::FingerContact* astray = nullptr;
  for (plan::FingerContact& finger : after) {
    const auto same = std::ranges::find(left, finger.contact.face, &grasp::Contact::face);
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

FingerSequence::FingerSequence(const grasp::Grasp& start, int fingers)
    : candidate_(planning::StartOf(start)),
      fingers_(fingers),
      holding_(candidate_.initial),
      held_before_(candidate_.initial) {}

void FingerSequence::SwitchTo(const grasp::Grasp& after,
                              std::optional<search::VertexPair> chosen_for,
                              std::optional<double> region) {
  plan::Switch step = planning::MakeSwitch(holding_, after, fingers_);
  if (IsEmpty(step)) return;
  for (plan::FingerContact& placed : step.place) placed.region = region;
  if (!region && CanJoinLastSwitch(after)) {
    step = planning::MakeSwitch(held_before_, after, fingers_);
    holding_ = held_before_;
    candidate_.steps.pop_back();
    candidate_.grasps.pop_back();
  }
  AddStep(std::move(step), chosen_for);
}

void FingerSequence::AlignAlong(const std::vector<grasp::Grasp>& waypoints,
                                std::optional<search::VertexPair> chosen_for) {
  plan::Align align = {{holding_}};
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    align.waypoints.push_back(FollowTo(align.waypoints.back(), waypoints[i]));
  }
  AddStep(std::move(align), chosen_for);
}

bool FingerSequence::CanJoinLastSwitch(const grasp::Grasp& after) const {
  if (candidate_.steps.empty() || !std::holds_alternative<plan::Switch>(candidate_.steps.back())) {
    return false;
  }
  const auto placed = std::ranges::count_if(
      after, [&](const grasp::Contact& contact) { return !Holds(held_before_, contact); });
  return std::ssize(held_before_) + placed <= fingers_ &&
         !IsEmpty(planning::MakeSwitch(held_before_, after, fingers_));
}

void FingerSequence::AddStep(plan::Step step, std::optional<search::VertexPair> chosen_for) {
  held_before_ = holding_;
  holding_ = plan::GraspAfter(holding_, step);
  candidate_.grasps.push_back({plan::ContactsOf(holding_), chosen_for});
  candidate_.steps.push_back(std::move(step));
}

}  // namespace regrasp::sets
