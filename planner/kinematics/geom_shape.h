#pragma once

#include <mujoco/mujoco.h>

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
                                     int tip_body, const collision::Ball& sphere);

}  // namespace regrasp::kinematics
