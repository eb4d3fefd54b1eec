#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <vector>

#include "planner/sets/contour/contour_graph.h"

namespace regrasp {

// The merge of a contour graph's pieces by a second route, CGAL's exact union of polygons: the
// benchmark's baseline.

using UnionKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using UnionPolygon = CGAL::Polygon_2<UnionKernel>;
using UnionComponent = CGAL::Polygon_with_holes_2<UnionKernel>;

/// The outlines of all pieces on the ring pair of the outer ring with itself, in [0, L]².
struct PieceOutlines {
  std::vector<contour::PieceIndex> pieces;
  std::vector<UnionPolygon> outlines;
};
[[nodiscard]] PieceOutlines MakePieceOutlines(const contour::ContourGraph& graph);

/// Their union, components one by one.
[[nodiscard]] std::vector<UnionComponent> Unite(const std::vector<UnionPolygon>& outlines);

/// How many sets the components are, once those are joined that meet at the start of the ring,
/// where [0, L]² is cut: a passage of the graph leads from the one to the other.
[[nodiscard]] int CountGlued(const contour::ContourGraph& graph, const PieceOutlines& outlines,
                             const std::vector<UnionComponent>& components);

}  // namespace regrasp
