#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// A geom as a convex shape that contains it, in the geom's own frame, metres. A mesh is the hull
/// of its vertices, a cylinder a prism of 16 sides around it, an ellipsoid a polyhedron around it.
/// Planes and height fields have none: no points.
[[nodiscard]] collision::ConvexShape ShapeOfGeom(const mjModel& model, int geom);

/// Return whether the fingertip sphere stands for a geom: the geom is of the fingertip's body, or
/// of a body fixed to it and lies inside the sphere, as marker links do.
/// @param rest      positions of a configuration of the model.
/// @param tip_body  body of the fingertip.
/// @param sphere    fingertip sphere in the frame of `tip_body`, metres.
[[nodiscard]] bool IsPartOfFingertip(const mjModel& model, const mjData& rest, int geom,
                                     int tip_body, const collision::BoundingSphere& sphere);

/// Where a fingertip touches: with its far end, and with its pad, at right angles to each other.
struct TipDirections {
  Eigen::Vector3d far = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d pad = Eigen::Vector3d::Zero();  ///< zero where there is none
};

struct FittedBall {
  collision::BoundingSphere ball;
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
