#pragma once

#include <array>
#include <vector>

#include "planner/object/polygon.h"

namespace regrasp::object {

/// Cuts a polygon into counter-clockwise triangles without new vertices (a constrained Delaunay
/// triangulation with exact predicates).
/// @returns three vertices each, numbered over the rings in their order.
[[nodiscard]] std::vector<std::array<int, 3>> TriangulatePolygon(const Polygon& polygon);

}  // namespace regrasp::object
