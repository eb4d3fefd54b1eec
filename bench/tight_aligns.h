#pragma once

#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// Random aligns of grasps that need every finger: force closure all the way, and without any one
/// of their contacts not, neither at the beginning nor at the end. The hand has no other finger.
///
/// Contacts are drawn evenly over the surface where a fingertip has room, five in space and three
/// in the plane; each moves straight inside its face by up to kTightMove of the diameter.
/// @param half_angle  friction, radians; both grasps at rest have kTightQuality at it.
[[nodiscard]] std::vector<plan::Plan> DrawTightAligns(const object::Object& object,
                                                      double half_angle, int count,
                                                      std::uint64_t seed);

inline constexpr double kTightMove = 0.1;
inline constexpr double kTightQuality = 0.015;  ///< above the shake, so that a fail is the align's

}  // namespace regrasp
