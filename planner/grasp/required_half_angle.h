#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// The angle between two vectors, radians in [0, π], accurate near 0 and π too.
[[nodiscard]] inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Certified bounds on the smallest friction half-angle at which a grasp is force closure, radians.
/// At `upper` the grasp is force closure; at and below `lower` it is not.
struct RequiredHalfAngle {
  double lower = 0;
  double upper = 0;
};

/// The smallest half-angle θ at which the contacts are force closure, to `tolerance` radians.
/// Where angles closer to it are too close to call the bounds are farther apart than that, by up to
/// 1e-7 in all random grasps seen.
/// @returns nullopt where none below π/2 is enough (to within 1e-6 rad).
/// @throws std::invalid_argument  as TestForceClosure; tolerance not > 0.
[[nodiscard]] std::optional<RequiredHalfAngle> ComputeRequiredHalfAngle(
    std::span<const Contact> contacts, const object::WrenchFrame& frame, double tolerance = 1e-9);

/// The same between bounds that are known: the grasp is force closure at known.upper, and whatever
/// it needs no less than known.lower is asked for. Radians.
/// @throws std::invalid_argument  as ComputeRequiredHalfAngle.
[[nodiscard]] RequiredHalfAngle NarrowRequiredHalfAngle(std::span<const Contact> contacts,
                                                        const object::WrenchFrame& frame,
                                                        const RequiredHalfAngle& known,
                                                        double tolerance);

}  // namespace regrasp::grasp
