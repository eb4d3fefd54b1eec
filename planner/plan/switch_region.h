#pragma once

#include <optional>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// What is claimed and what is true of the contact regions of a switch between 2-finger grasps.
struct SwitchRegion {
  /// The smaller one of the contact regions of the grasps before and after
  /// (planner/plan/contact_region.h), the object's unit of length.
  double half_width = 0;
  /// The smallest `region` of the placed contacts, if one has it.
  std::optional<double> claimed = std::nullopt;
  /// Nothing is claimed, or no more than is true, to within kPointTolerance · D.
  bool holds = true;
};

/// Measures the regions of a switch; nullopt where the grasp before or after is not of two
/// contacts.
/// @param before  the grasp that holds before the switch, located like the switch (LocatePlan).
/// @param half_angle  θ, radians, in (0, π/2).
[[nodiscard]] std::optional<SwitchRegion> MeasureSwitchRegion(const object::Polygon& polygon,
                                                              const FingerGrasp& before,
                                                              const Switch& step,
                                                              double half_angle);

}  // namespace regrasp::plan
