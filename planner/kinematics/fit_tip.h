#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// Where a fingertip touches: with its far end, and with its pad, at right angles to each other.
struct TipDirections {
  Eigen::Vector3d far = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d pad = Eigen::Vector3d::Zero();  ///< zero where there is none
};

struct FittedBall {
  collision::Ball ball;
  double short_of_far = 0;  ///< how far its far end is inside the shape, metres
  double short_of_pad = 0;
};

/// The ball of a fingertip of some shape. Of a ball or a capsule it is the ball of its far end. Of
/// another shape it is the one inside it that comes nearest to its far end and its pad, and the
/// largest of those:
///
///     maximise (far + pad) · c + (k + ¹⁄₁₀₀) r   over   aⱼ · c + r ≤ bⱼ for all facets j,
///
/// k the number of directions, a linear program in four unknowns.
///
/// Laws: rigid motion moves the ball along; of a box of width w it is the ball of radius w/2 at the
/// end, of a ball it is that ball up to the facets that stand for it.
/// @throws std::runtime_error  the points span no volume.
[[nodiscard]] FittedBall FitTip(const collision::ConvexShape& shape,
                                const TipDirections& directions);

}  // namespace regrasp::kinematics
