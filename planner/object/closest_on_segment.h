#pragma once

#include <Eigen/Core>

namespace regrasp::object {

/// Return the point of the segment ab nearest to `point`; a if the segment has no length.
[[nodiscard]] inline Eigen::Vector3d ClosestOnSegment(const Eigen::Vector3d& a,
                                                      const Eigen::Vector3d& b,
                                                      const Eigen::Vector3d& point) {
  const Eigen::Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  if (!(length_squared > 0)) return a;
  const double t = (point - a).dot(along) / length_squared;
  if (t <= 0) return a;
  if (t >= 1) return b;
  return a + t * along;
}

}  // namespace regrasp::object
