#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

namespace regrasp::collision {

/// Return the point farthest in a direction; the first one in case of ties.
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

/// Return the point of the simplex's hull nearest to the origin.
/// Removes corners that do not contribute to it. Four corners remain only if the origin is inside.
[[nodiscard]] Eigen::Vector3d ReduceToNearest(HullSimplex& simplex);

/// Pair of nearest points of two hulls.
struct NearestPair {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// Find the nearest points of two convex hulls.
/// Uses the algorithm of Gilbert, Johnson and Keerthi (1988).
/// Their distance is minimal to a relative 1e-9 on convergence.
/// @param a, b  at least one point each.
/// @returns nullopt if the hulls intersect, up to rounding.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(std::span<const Eigen::Vector3d> a,
                                                           std::span<const Eigen::Vector3d> b);

}  // namespace regrasp::collision
