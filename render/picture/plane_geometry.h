#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace regrasp::render {

/// The z component of the cross product: positive where b is to the left of a.
[[nodiscard]] inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far p is from the segment from a to b, which may be a point.
[[nodiscard]] inline double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b) {
  const Eigen::Vector2d segment = b - a;
  const double square = segment.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(segment) / square, 0.0, 1.0) : 0;
  return (p - a - t * segment).norm();
}

}  // namespace regrasp::render
