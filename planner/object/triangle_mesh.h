#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::object {

using TriangleIndex = Index<struct TriangleTag>;

/// Triangles with their places in the file, so that checks can name what they find.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<int> facet_of_triangle;         ///< the file's facets, counted from 0
  /// What is flat, counted from 0 in the file's order: a facet, or a triangle of a bent one.
  std::vector<int> flat_of_triangle;
  int flat_count = 0;
};

/// Twice the area of a triangle times its unit outward normal.
[[nodiscard]] Eigen::Vector3d DoubleAreaVector(const TriangleMesh& mesh, TriangleIndex triangle);

/// "vertex 3 (0.1, 0, 2.5)", as the file counts.
[[nodiscard]] std::string VertexName(const TriangleMesh& mesh, int vertex);

/// "facet 12", as the file counts.
[[nodiscard]] std::string FacetName(const TriangleMesh& mesh, TriangleIndex triangle);

/// One side of an edge: from the corner `corner` of a facet to the next.
struct EdgeSide {
  int low, high;  ///< the vertices, in order
  int facet;
  int corner;
  bool forward;  ///< the facet runs from low to high
};

/// All sides of all edges, sorted by edge and facet.
/// @param facets  polygons or triangles, as vertices below `vertex_count`.
template <class Corners>
[[nodiscard]] std::vector<EdgeSide> SortedEdgeSides(const std::vector<Corners>& facets,
                                                    std::size_t vertex_count) {
  const auto visit = [&](auto&& put) {
    for (int f = 0; f < std::ssize(facets); ++f) {
      const int corners = static_cast<int>(std::size(facets[f]));
      for (int k = 0; k < corners; ++k) {
        const int from = facets[f][k], to = facets[f][k + 1 < corners ? k + 1 : 0];
        put({std::min(from, to), std::max(from, to), f, k, from < to});
      }
    }
  };
  // By the lower vertex they are counted into place: few are left to be sorted at each.
  std::vector<std::size_t> end(vertex_count + 1);
  visit([&](const EdgeSide& side) { ++end[side.low + 1]; });
  for (std::size_t v = 0; v < vertex_count; ++v) end[v + 1] += end[v];
  std::vector<EdgeSide> sides(end[vertex_count]);
  visit([&](const EdgeSide& side) { sides[end[side.low]++] = side; });
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(end[first->low]);
    std::sort(first, last, [](const EdgeSide& a, const EdgeSide& b) {
      return std::tie(a.high, a.facet, a.corner) < std::tie(b.high, b.facet, b.corner);
    });
    first = last;
  }
  return sides;
}

/// Calls `visit` with the sides of each edge, as a span.
template <class Visit>
void ForEachEdge(std::span<const EdgeSide> sides, const Visit& visit) {
  while (!sides.empty()) {
    const EdgeSide& first = sides.front();
    const auto last = std::ranges::find_if(sides, [&](const EdgeSide& side) {
      return side.low != first.low || side.high != first.high;
    });
    const auto count = static_cast<std::size_t>(last - sides.begin());
    visit(sides.first(count));
    sides = sides.subspan(count);
  }
}

/// Which triangles are neighbours on a closed, consistently oriented 2-manifold.
struct SurfaceTopology {
  /// neighbor[t][k]: the triangle across the edge from corner k to corner k + 1 of triangle t.
  std::vector<std::array<TriangleIndex, 3>> neighbor;
  std::vector<int> shell;  ///< of each triangle: connected part of the surface, counted from 0
  int shell_count = 0;
};

/// Joins triangles at their edges and checks that each edge has two, running along it in opposite
/// directions, and that the triangles about each vertex are one fan.
/// @throws MeshError  kNotClosed, kNotManifold or kNotOriented, with facets and vertices named.
[[nodiscard]] SurfaceTopology ComputeTopology(const TriangleMesh& mesh, const std::string& name);

}  // namespace regrasp::object
