#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <vector>

#include "planner/sets/contour/contour_graph.h"

namespace regrasp {

// Baseline of the benchmark: merge of the pieces of a contour graph by an independent method, the
// exact union of polygons by CGAL.

using UnionKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using UnionPolygon = CGAL::Polygon_2<UnionKernel>;
using UnionComponent = CGAL::Polygon_with_holes_2<UnionKernel>;

/// Outlines of all pieces on the ring pair of the outer ring with itself, in [0, L]².
struct PieceOutlines {
  std::vector<contour::PieceIndex> pieces;
  std::vector<UnionPolygon> outlines;
};
[[nodiscard]] PieceOutlines MakePieceOutlines(const contour::ContourGraph& graph);

/// Return the components of their union.
[[nodiscard]] std::vector<UnionComponent> Unite(const std::vector<UnionPolygon>& outlines);

/// Return the number of connected sets after joining components that meet at the start of the ring,
/// at which [0, L]² is cut. A passage of the graph connects such components.
[[nodiscard]] int CountGlued(const contour::ContourGraph& graph, const PieceOutlines& outlines,
                             const std::vector<UnionComponent>& components);

}  // namespace regrasp
