#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Bounds on the distance of the convex hulls of two sets of points, as Distance has them of shapes
/// without radii.
/// @param decided  the work ends where both bounds are known to be on one side of this.
[[nodiscard]] DistanceBounds HullDistance(std::span<const Eigen::Vector3d> a,
                                          std::span<const Eigen::Vector3d> b,
                                          std::optional<double> decided = std::nullopt);

}  // namespace regrasp::collision
