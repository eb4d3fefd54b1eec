#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

namespace regrasp::collision {

/// Of some points one that is farthest in a direction; the first of those equally far.
/// @param points  at least one.
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

/// One to four points in space.
struct HullSimplex {
  std::array<Eigen::Vector3d, 4> points;
  int size = 0;
};

/// The point of the simplex's hull that is nearest to the origin. Corners that it does not need are
/// taken out of the simplex; four are left only where the origin is inside.
[[nodiscard]] Eigen::Vector3d ReduceToNearest(HullSimplex& simplex);

/// Points of two hulls that are nearest to each other.
struct NearestPair {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// The nearest points of the convex hulls of two sets of points, by the algorithm of Gilbert,
/// Johnson and Keerthi (1988): their distance is the least to a relative 1e-9 where it converges.
/// @param a, b  at least one point each.
/// @returns nullopt where the hulls meet, up to rounding.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(std::span<const Eigen::Vector3d> a,
                                                           std::span<const Eigen::Vector3d> b);

}  // namespace regrasp::collision
