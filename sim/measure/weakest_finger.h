#pragma once

#include <optional>
#include <vector>

#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// Weakest fingers of the static grasps of an entry: those with the smallest friction margin of
/// their own.
/// The grasps of an entry are the initial grasp, or those before and after a finger switch, or
/// those at the waypoints of a sliding step. The criterion is that of
/// planner/grasp/required_friction_angle.h; among equal fingers, the first.
class WeakestFingers {
 public:
  /// @param located  plan with contacts on the surface, in the unit of `frame`; must outlive this
  ///     object.
  WeakestFingers(const plan::Plan& projected, const object::WrenchFrame& frame,
                 double friction_angle)
      : projected_(projected), frame_(frame), friction_angle_(friction_angle) {}

  /// Return the weakest finger of an entry.
  /// @returns nullopt if the entry has no contacts, or none of its grasps is force closure.
  [[nodiscard]] std::optional<NeedOfFinger> OfEntry(plan::EntryIndex index);

 private:
  std::optional<NeedOfFinger> OfGrasp(const plan::FingerGrasp& grasp);

  const plan::Plan& projected_;
  object::WrenchFrame frame_;
  double friction_angle_;
  // Last grasp of the previous entry, which is the first of the next one.
  plan::FingerGrasp last_;
  std::optional<NeedOfFinger> last_weakest_;
};

/// Return the grasps of an entry in order of time (see WeakestFingers).
[[nodiscard]] std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& projected,
                                                           plan::EntryIndex index);

}  // namespace regrasp::sim
