#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Bounds of the distance of two hulls, with the direction of the lower bound.
/// The direction points from the second hull to the first and has any length.
struct HullBounds : DistanceBounds {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Compute bounds of the distance of two convex hulls, as Distance for shapes with radius 0.
/// @param decided  distance at which the computation can stop early: when both bounds are on one
///     side of it.
[[nodiscard]] HullBounds HullDistance(std::span<const Eigen::Vector3d> a,
                                      std::span<const Eigen::Vector3d> b,
                                      std::optional<double> decided = std::nullopt);

/// Return whether two hulls are farther apart along a direction than `distance`.
/// This requires only dot products, and is useful if the direction is known from nearby hulls.
[[nodiscard]] bool AreApartAlong(std::span<const Eigen::Vector3d> a,
                                 std::span<const Eigen::Vector3d> b,
                                 const Eigen::Vector3d& direction, double distance);

}  // namespace regrasp::collision
