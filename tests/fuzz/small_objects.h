#pragma once

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// Return the cube [-1, 1]^3, the object of the plans and grasps in tests/data.
[[nodiscard]] const object::Polyhedron& SmallSolid();

/// Return the square [-1, 1]^2.
[[nodiscard]] const object::Polygon& SmallPolygon();

}  // namespace regrasp
