#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Return the angle between two vectors, radians in [0, π], also accurate near 0 and π.
[[nodiscard]] inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Certified bounds on the required friction angle of a grasp, radians.
/// At `upper` the grasp is force closure; at and below `lower` it is not.
struct RequiredFrictionAngle {
  double lower = 0;
  double upper = 0;
};

/// Compute the smallest friction angle θ at which the contacts are force closure.
/// If angles closer to it are too close to call, the bounds are farther apart than `tolerance`, by
/// up to 1e-7 for all random grasps tested.
/// @param tolerance  largest distance between the bounds, radians, > 0.
/// @returns bounds; nullopt if no angle below π/2 is enough (to within 1e-6 rad).
/// @throws std::invalid_argument  as TestForceClosure, or if the tolerance is not > 0.
[[nodiscard]] std::optional<RequiredFrictionAngle> ComputeRequiredFrictionAngle(
    std::span<const Contact> contacts, const object::WrenchFrame& frame, double tolerance = 1e-9);

/// Compute the required friction angle within known bounds, radians.
/// @param known  bounds: the grasp is force closure at known.upper, and angles below known.lower
///     are irrelevant.
/// @throws std::invalid_argument  as ComputeRequiredFrictionAngle.
[[nodiscard]] RequiredFrictionAngle NarrowRequiredFrictionAngle(std::span<const Contact> contacts,
                                                                const object::WrenchFrame& frame,
                                                                const RequiredFrictionAngle& known,
                                                                double tolerance);

}  // namespace regrasp::grasp
