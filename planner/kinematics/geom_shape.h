#pragma once

#include <mujoco/mujoco.h>

#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// A geom as a convex shape that contains it, in the geom's own frame, metres. A mesh is the hull
/// of its vertices, a cylinder a prism of 16 sides around it, an ellipsoid a polyhedron around it.
/// Planes and height fields have none: no points.
[[nodiscard]] collision::ConvexShape ShapeOfGeom(const mjModel& model, int geom);

}  // namespace regrasp::kinematics
