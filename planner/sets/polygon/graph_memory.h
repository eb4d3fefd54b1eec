#pragma once

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/planning/spanning.h"

namespace regrasp::polygon {

/// What a PolygonGraph takes at most while it is built, within a factor of two.
///
/// The vertices on at most forty edges, drawn from all of them, are counted; vertices on three
/// edges go with the third power of how many edges there are, the joins with the square of the
/// vertices over that of the edges. What a vertex and a join take was measured.
///
/// Laws: the same polygon gives the same number; a polygon of forty edges or fewer is counted
/// whole.
[[nodiscard]] MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double half_angle,
                                              planning::Spanning spanning);

}  // namespace regrasp::polygon
