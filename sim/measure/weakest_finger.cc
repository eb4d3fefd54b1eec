#include "sim/measure/weakest_finger.h"

#include "planner/plan/plan.h"

namespace regrasp::sim {

std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& projected, plan::EntryIndex index) {
  if (index == 0) return {projected.initial};
  plan::FingerGrasp before = projected.initial;
  for (plan::EntryIndex earlier{1}; earlier < index; ++earlier) {
    before = plan::GraspAfter(before, plan::StepOf(projected, earlier));
  }
  const plan::Step& step = plan::StepOf(projected, index);
  if (const auto* align = std::get_if<plan::Align>(&step)) return align->waypoints;
  return {before, plan::GraspAfter(before, step)};
}

std::optional<NeedOfFinger> WeakestFingers::OfEntry(plan::EntryIndex index) {
  std::optional<NeedOfFinger> weakest;
  for (const plan::FingerGrasp& grasp : GraspsOfEntry(projected_, index)) {
    const std::optional<NeedOfFinger> need = OfGrasp(grasp);
    if (!need) continue;
    if (!weakest || grasp::WeakestFinger({weakest->friction, need->friction}) == 1) weakest = need;
  }
  return weakest;
}

std::optional<NeedOfFinger> WeakestFingers::OfGrasp(const plan::FingerGrasp& grasp) {
  if (plan::AreIdentical(grasp, last_)) return last_weakest_;
  last_ = grasp;
  last_weakest_.reset();
  if (grasp.empty()) return last_weakest_;
  const auto found = grasp::FindWeakestFinger(plan::ContactsOf(grasp), frame_, friction_angle_);
  if (found) last_weakest_ = {grasp[found->finger].finger, found->friction};
  return last_weakest_;
}

}  // namespace regrasp::sim
