#pragma once

#include <Eigen/Core>
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

}  // namespace regrasp::collision
