#include "sim/measure/weakest_finger.h"

namespace regrasp::sim {

std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& located, plan::EntryIndex index) {
  if (index == 0) return {located.initial};
  plan::FingerGrasp before = located.initial;
  for (plan::EntryIndex earlier{1}; earlier < index; ++earlier) {
    before = plan::GraspAfter(before, plan::StepOf(located, earlier));
  }
  const plan::Step& step = plan::StepOf(located, index);
  if (const auto* align = std::get_if<plan::Align>(&step)) return align->waypoints;
  return {before, plan::GraspAfter(before, step)};
}

std::vector<NeedOfFinger> NeedsOfEntry(const plan::Plan& located, plan::EntryIndex index,
                                       const object::WrenchFrame& frame, double half_angle) {
  std::vector<NeedOfFinger> needs;
  for (const plan::FingerGrasp& grasp : GraspsOfEntry(located, index)) {
    if (grasp.empty()) continue;
    const auto friction = grasp::MeasureFingerFriction(plan::ContactsOf(grasp), frame, half_angle);
    for (std::size_t i = 0; i < friction.size(); ++i) {
      needs.push_back({grasp[i].finger, friction[i]});
    }
  }
  return needs;
}

int WeakestOf(const std::vector<NeedOfFinger>& needs) {
  std::vector<grasp::FingerFriction> friction;
  for (const NeedOfFinger& need : needs) friction.push_back(need.friction);
  return grasp::WeakestFinger(friction);
}

}  // namespace regrasp::sim
