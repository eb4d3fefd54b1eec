#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// Return a convex shape that contains a geom, in the geom's frame, metres.
/// A mesh becomes the hull of its vertices, a cylinder a prism of 16 sides around it, and an
/// ellipsoid a polyhedron around it. The shape of planes and height fields has no points.
[[nodiscard]] collision::ConvexShape ShapeOfGeom(const mjModel& model, int geom);

/// Return whether the fingertip sphere represents a geom.
/// The geom belongs to the fingertip's body, or to a body fixed to it and lies inside the sphere,
/// like the geoms of marker links.
/// @param rest      positions of a configuration of the model.
/// @param tip_body  body of the fingertip.
/// @param sphere    fingertip sphere in the frame of `tip_body`, metres.
[[nodiscard]] bool IsPartOfFingertip(const mjModel& model, const mjData& rest, int geom,
                                     int tip_body, const collision::BoundingSphere& sphere);

/// Directions of contact of a fingertip: its far end and its pad, perpendicular to each other.
struct TipDirections {
  Eigen::Vector3d far = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d pad = Eigen::Vector3d::Zero();  ///< zero if there is none
};

struct FittedBall {
  collision::BoundingSphere ball;
  double short_of_far = 0;  ///< gap between the sphere's far end and the shape's, metres
  double short_of_pad = 0;
};

/// Fit a fingertip sphere to a shape.
/// For a sphere or a capsule it is the sphere at its far end. For another shape it is the inscribed
/// sphere nearest to the far end and the pad, and the largest of these:
///
///     maximise (far + pad) · c + (k + 1) r   over   aⱼ · c + r ≤ bⱼ for all faces j,
///
/// k the number of directions, a linear program in four unknowns.
///
/// Laws: rigid motion moves the sphere with the shape. A box of width w gives the sphere of radius
/// w/2 at its end. A polyhedron around a sphere gives this sphere, up to the polyhedron's
/// approximation.
/// @throws std::runtime_error  if the points span no volume.
[[nodiscard]] FittedBall FitTip(const collision::ConvexShape& shape,
                                const TipDirections& directions);

}  // namespace regrasp::kinematics
