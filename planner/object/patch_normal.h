#pragma once

#include <Eigen/Core>

#include "planner/object/object.h"

namespace regrasp::object {

class Polyhedron;

/// Compute the normal that a fingertip feels on its contact patch.
///
/// It is the unit mean, weighted by area, of the surface's inward normals inside a ball about a
/// point. Only surface that is connected with the point inside the ball counts, so the far side of
/// a wall does not.
///
/// Let δ be the angle between the face's normal and this one. A friction cone about the face's
/// normal, narrowed by δ, is inside the cone about this normal. A grasp that is force closure with
/// the narrower cones is therefore force closure with the others.
///
/// Laws: independent of rigid motion, of the unit of length and of the triangulation; equal to the
/// face's normal if the whole patch is on the face.
/// @param face  face on which the point is.
/// @param radius  radius of the ball in units of the solid, > 0.
[[nodiscard]] Eigen::Vector3d PatchNormal(const Polyhedron& solid, FaceIndex face,
                                          const Eigen::Vector3d& point, double radius);

}  // namespace regrasp::object
