#pragma once

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// The cube [-1, 1]^3, which the plans and grasps of tests/data are of.
[[nodiscard]] const object::Polyhedron& SmallSolid();

/// The square [-1, 1]^2.
[[nodiscard]] const object::Polygon& SmallPolygon();

}  // namespace regrasp
