#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Return the point that is farthest in a direction, the first of several equally far.
/// @param points  at least one point.
[[nodiscard]] inline const Eigen::Vector3d& Farthest(std::span<const Eigen::Vector3d> points,
                                                     const Eigen::Vector3d& direction) {
  const Eigen::Vector3d* best = points.data();
  double most = best->dot(direction);
  for (const Eigen::Vector3d& point : points) {
    const double reached = point.dot(direction);
    if (reached > most) {
      most = reached;
      best = &point;
    }
  }
  return *best;
}

/// Simplex of one to four points.
struct HullSimplex {
  std::array<Eigen::Vector3d, 4> points;
  int size = 0;
};

/// Return the point of the simplex's hull that is nearest to the origin.
///
/// Corners that this point does not need are removed from the simplex. Four corners remain only if
/// the origin is inside.
[[nodiscard]] Eigen::Vector3d ReduceToNearest(HullSimplex& simplex);

/// Pair of nearest points of two hulls.
struct NearestPair {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// Find the nearest points of the convex hulls of two sets of points.
///
/// The algorithm of Gilbert, Johnson and Keerthi (1988). If it converges, the distance of the two
/// points is the least to a relative 1e-9.
/// @param a, b  at least one point each.
/// @returns the points; nullopt if the hulls meet, up to rounding.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(std::span<const Eigen::Vector3d> a,
                                                           std::span<const Eigen::Vector3d> b);

/// Bounds on the distance of two hulls, and the direction of any length from the second hull to the
/// first that has the lower bound.
struct HullBounds : DistanceBounds {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Compute bounds on the distance of the convex hulls of two sets of points, as Distance does for
/// shapes without radii.
/// @param decided  distance; the computation ends as soon as both bounds are on one side of it.
[[nodiscard]] HullBounds HullDistance(std::span<const Eigen::Vector3d> a,
                                      std::span<const Eigen::Vector3d> b,
                                      std::optional<double> decided = std::nullopt);

/// Return whether two hulls are farther apart along a direction than `distance`.
///
/// Cheap if the direction is known, for example from hulls nearby.
[[nodiscard]] bool AreApartAlong(std::span<const Eigen::Vector3d> a,
                                 std::span<const Eigen::Vector3d> b,
                                 const Eigen::Vector3d& direction, double distance);

}  // namespace regrasp::collision
