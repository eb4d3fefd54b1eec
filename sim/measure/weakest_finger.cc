#include "sim/measure/weakest_finger.h"

namespace regrasp::sim {

std::vector<FingerGrasp> GraspsOfEntry(const Plan& located, int index) {
  if (index == 0) return {located.initial};
  FingerGrasp before = located.initial;
  for (int i = 0; i + 1 < index; ++i) before = GraspAfter(before, located.steps[i]);
  const Step& step = located.steps[index - 1];
  if (const auto* align = std::get_if<Align>(&step)) return align->waypoints;
  return {before, GraspAfter(before, step)};
}

std::vector<NeedOfFinger> NeedsOfEntry(const Plan& located, int index, const WrenchFrame& frame,
                                       double half_angle) {
  std::vector<NeedOfFinger> needs;
  for (const FingerGrasp& grasp : GraspsOfEntry(located, index)) {
    if (grasp.empty()) continue;
    const auto friction = MeasureFingerFriction(ContactsOf(grasp), frame, half_angle);
    for (std::size_t i = 0; i < friction.size(); ++i) {
      needs.push_back({grasp[i].finger, friction[i]});
    }
  }
  return needs;
}

int WeakestOf(const std::vector<NeedOfFinger>& needs) {
  std::vector<FingerFriction> friction;
  for (const NeedOfFinger& need : needs) friction.push_back(need.friction);
  return WeakestFinger(friction);
}

}  // namespace regrasp::sim
