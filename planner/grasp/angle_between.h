#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace regrasp::grasp {

/// The angle between two vectors, radians in [0, π], accurate near 0 and π too.
[[nodiscard]] inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace regrasp::grasp
