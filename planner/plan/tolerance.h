#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "planner/base/angle.h"

namespace regrasp {

/// Normals in files must be of unit length within this (docs/formats.md).
inline constexpr double kNormalLengthTolerance = 1e-4;

/// Normals in files must be within this of a face's own normal, radians: 0.1° (docs/formats.md).
inline constexpr double kNormalTolerance = Radians(0.1);

/// The angle between two vectors, radians in [0, π], accurate near 0 and π too.
[[nodiscard]] inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace regrasp
