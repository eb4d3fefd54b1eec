#pragma once

#include <Eigen/Core>
#include <array>

namespace regrasp::collision {

/// One to four points in space.
struct Simplex {
  std::array<Eigen::Vector3d, 4> points;
  int size = 0;
};

/// The point of the simplex's hull that is nearest to the origin. Corners that it does not need are
/// taken out of the simplex; four are left only where the origin is inside.
[[nodiscard]] Eigen::Vector3d ReduceToNearest(Simplex& simplex);

}  // namespace regrasp::collision
