#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <array>
#include <vector>

#include "planner/object/polygon.h"

namespace regrasp {

// The concurrent part of a polygon's switching graph by a second route, CGAL's exact Boolean
// operations on polygons: the tests' oracle and the benchmark's baseline.

using CellKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using CellSet = CGAL::Polygon_set_2<CellKernel>;

/// A connected component of the interior of a focus cell.
struct SetCell {
  std::array<int, 3> edges;  ///< ascending
  CGAL::Polygon_with_holes_2<CellKernel> component;
};

/// Three edges, ascending, whose normals pass the test on normals alone.
struct SetCandidate {
  std::array<int, 3> edges;
  double tangent;  ///< tan φ
};

/// The three inward normals φ-positively span the plane, tan φ = `tangent` >= 0: every gap between
/// neighbouring normals is less than π − 2φ (for `closed`, at most). Exact.
[[nodiscard]] bool NormalsSpan(const object::Polygon& polygon, const std::array<int, 3>& edges,
                               double tangent, bool closed = false);

/// The triples whose normals θ-positively span, with tan θ; in lexicographic order, as the next.
[[nodiscard]] std::vector<SetCandidate> FindUniformCandidates(const object::Polygon& polygon,
                                                              double half_angle);

/// The triples whose normals positively span, with the smaller of tan θ and the largest double not
/// above tan φ*.
[[nodiscard]] std::vector<SetCandidate> FindAdaptiveCandidates(const object::Polygon& polygon,
                                                               double half_angle);

/// What sees an edge inside its double-sided cones: a hexagon about the open edge. It ends at
/// `reach` edge lengths from the edge's line.
[[nodiscard]] CellSet SeeingEdge(const object::Polygon& polygon, int edge, double tangent,
                                 double reach);

/// How far is far enough for what the tests and the benchmark look at; over the length of an edge.
inline constexpr double kCellReach = 0x1p40;

/// The components of the candidates' focus cells, in their order. What sees an edge is built once
/// for each tangent, and what sees the first two edges of a triple is kept for the triples that
/// follow.
[[nodiscard]] std::vector<SetCell> FindSetCells(const object::Polygon& polygon,
                                                const std::vector<SetCandidate>& candidates,
                                                double reach = kCellReach);

/// The pairs of cells (indices, the first smaller) with exactly two edges in common and a common
/// interior.
[[nodiscard]] std::vector<std::array<int, 2>> FindSetCellSwitches(
    const std::vector<SetCell>& cells);

}  // namespace regrasp
