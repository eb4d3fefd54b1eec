#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <array>
#include <vector>

#include "planner/object/polygon.h"

namespace regrasp {

// Concurrent part of a polygon's switching graph by CGAL.
// CGAL's exact Boolean operations on polygons are an independent method. The tests use it as an
// oracle, the benchmark as a baseline.

using CellKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using CellSet = CGAL::Polygon_set_2<CellKernel>;

/// Connected component of the interior of a focus cell.
struct SetCell {
  std::array<int, 3> edges;  ///< edge indices, ascending
  CGAL::Polygon_with_holes_2<CellKernel> component;
};

/// Three edges, ascending, whose normals pass the test on normals alone.
struct SetCandidate {
  std::array<int, 3> edges;
  double tangent;  ///< tan φ
};

/// Return true if the three inward normals φ-positively span the plane, with tan φ = `tangent` >=
/// 0.
/// Every gap between neighbouring normals is then less than π − 2φ (for `closed`, at most). Exact.
[[nodiscard]] bool NormalsSpan(const object::Polygon& polygon, const std::array<int, 3>& edges,
                               double tangent, bool closed = false);

/// Return the triples whose normals θ-positively span, with tan θ, in lexicographic order.
[[nodiscard]] std::vector<SetCandidate> FindUniformCandidates(const object::Polygon& polygon,
                                                              double friction_angle);

/// Return the triples whose normals positively span, in lexicographic order.
/// Their tangent is the smaller of tan θ and the largest double not above tan φ*.
[[nodiscard]] std::vector<SetCandidate> FindAdaptiveCandidates(const object::Polygon& polygon,
                                                               double friction_angle);

/// Return the points that see an edge inside their double-sided cones.
/// The set is a hexagon about the open edge. It ends at `reach` edge lengths from the edge's line.
[[nodiscard]] CellSet SeeingEdge(const object::Polygon& polygon, int edge, double tangent,
                                 double reach);

/// Default reach, in edge lengths: sufficient for all polygons of the tests and the benchmark.
inline constexpr double kCellReach = 0x1p40;

/// Return the components of the candidates' focus cells, in the order of the candidates. The set
/// that sees an edge is built once per tangent. The intersection of the first two edges of a triple
/// is reused for the triples that follow.
[[nodiscard]] std::vector<SetCell> FindSetCells(const object::Polygon& polygon,
                                                const std::vector<SetCandidate>& candidates,
                                                double reach = kCellReach);

/// Return the pairs of cells with exactly two common edges and a common interior.
/// Pairs are indices, the smaller first.
[[nodiscard]] std::vector<std::array<int, 2>> FindSetCellSwitches(
    const std::vector<SetCell>& cells);

}  // namespace regrasp
