#pragma once

#include <Eigen/Geometry>

#include "planner/base/random.h"

namespace regrasp::gait {

/// A turn drawn evenly among all: four normal numbers are a direction in four dimensions, which a
/// unit quaternion is.
[[nodiscard]] inline Eigen::Matrix3d DrawTurn(RandomStream& random) {
  Eigen::Quaterniond turn;
  for (int k = 0; k < 4; ++k) turn.coeffs()[k] = random.Normal();
  return turn.normalized().toRotationMatrix();
}

}  // namespace regrasp::gait
