#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Bounds on the distance of two hulls, and the direction from the second to the first along which
/// the lower one was found, of any length.
struct HullBounds : DistanceBounds {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Bounds on the distance of the convex hulls of two sets of points, as Distance has them of shapes
/// without radii.
/// @param decided  the work ends where both bounds are known to be on one side of this.
[[nodiscard]] HullBounds HullDistance(std::span<const Eigen::Vector3d> a,
                                      std::span<const Eigen::Vector3d> b,
                                      std::optional<double> decided = std::nullopt);

/// Whether two hulls are farther apart along a direction than `distance`: a few products, where it
/// is known from hulls near by.
[[nodiscard]] bool AreApartAlong(std::span<const Eigen::Vector3d> a,
                                 std::span<const Eigen::Vector3d> b,
                                 const Eigen::Vector3d& direction, double distance);

}  // namespace regrasp::collision
