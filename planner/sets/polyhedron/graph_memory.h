#pragma once

#include "planner/base/memory.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/spanning.h"

namespace regrasp::polyhedron {

/// What a PolyhedronGraph takes at most while it is built, within a factor of two.
///
/// The candidates among at most sixty faces, drawn from all of them, are counted; they go with the
/// fourth power of how many faces there are. How many of them have a cell, how many cells are
/// joined and what these take was measured.
///
/// Laws: the same solid gives the same number; a solid of sixty faces or fewer has its candidates
/// counted whole.
[[nodiscard]] MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                                 planning::Spanning spanning);

}  // namespace regrasp::polyhedron
