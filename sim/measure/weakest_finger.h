#pragma once

#include <optional>
#include <vector>

#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// The finger that has the least of its own friction to spare in the grasps of an entry, at rest:
/// of the hold the initial grasp, of a switch the grasps before and after it, of an align the
/// grasps at its waypoints. As planner/grasp/finger_friction.h has it; of equal ones the first.
class WeakestFingers {
 public:
  /// @param located  contacts on the surface, in the unit of `frame`; must outlive this object.
  WeakestFingers(const plan::Plan& located, const object::WrenchFrame& frame, double half_angle)
      : located_(located), frame_(frame), half_angle_(half_angle) {}

  /// @returns nullopt where an entry has no contacts, or no grasp of it is force closure.
  [[nodiscard]] std::optional<NeedOfFinger> OfEntry(plan::EntryIndex index);

 private:
  std::optional<NeedOfFinger> OfGrasp(const plan::FingerGrasp& grasp);

  const plan::Plan& located_;
  object::WrenchFrame frame_;
  double half_angle_;
  // What one entry ends with the next one begins with.
  plan::FingerGrasp last_;
  std::optional<NeedOfFinger> last_weakest_;
};

/// The grasps of an entry, in the order of time (see WeakestFingers).
[[nodiscard]] std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& located,
                                                           plan::EntryIndex index);

}  // namespace regrasp::sim
