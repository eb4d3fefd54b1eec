#include "sim/measure/weakest_finger.h"

namespace regrasp::sim {

std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& located, int index) {
  if (index == 0) return {located.initial};
  plan::FingerGrasp before = located.initial;
  for (int i = 0; i + 1 < index; ++i) before = plan::GraspAfter(before, located.steps[i]);
  const plan::Step& step = located.steps[index - 1];
  if (const auto* align = std::get_if<plan::Align>(&step)) return align->waypoints;
  return {before, plan::GraspAfter(before, step)};
}

std::vector<NeedOfFinger> NeedsOfEntry(const plan::Plan& located, int index,
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
