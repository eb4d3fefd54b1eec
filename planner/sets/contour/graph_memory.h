#pragma once

#include "planner/base/memory.h"
#include "planner/object/polygon.h"

namespace regrasp::contour {

/// What a ContourGraph takes at most while it is built, within a factor of two.
///
/// The pairs of edges that are opposite but for 2θ are counted; how many have pieces is tested on
/// ten thousand of them, how many sets of pieces are joined on at most four hundred edges, drawn
/// from all of them in runs. Pieces go with the square of how many edges there are, joins with the
/// third power. What a piece and a join take was measured.
///
/// Law: the same polygon gives the same number.
[[nodiscard]] MemoryNeed EstimateContourGraph(const object::Polygon& polygon, double half_angle);

/// The same for what PlanOnContour takes: also the geometry of the sets that it looks at.
[[nodiscard]] MemoryNeed EstimateContourPlan(const object::Polygon& polygon, double half_angle);

}  // namespace regrasp::contour
