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

/// Triangles with their positions in the file, so that checks can name them.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<int> facet_of_triangle;         ///< polygon in the file, counted from 0
  /// Flat element of each triangle, counted from 0 in file order: a polygon, or a triangle of a
  /// bent polygon.
  std::vector<int> flat_of_triangle;
  int flat_count = 0;
};

/// Compute twice the area of a triangle times its unit outward normal.
[[nodiscard]] Eigen::Vector3d DoubleAreaVector(const TriangleMesh& mesh, TriangleIndex triangle);

/// Return the name of a vertex with its number in the file: "vertex 3 (0.1, 0, 2.5)".
[[nodiscard]] std::string VertexName(const TriangleMesh& mesh, int vertex);

/// Return the name of a triangle's polygon with its number in the file: `facet 12`.
[[nodiscard]] std::string FacetName(const TriangleMesh& mesh, TriangleIndex triangle);

/// Side of an edge in one polygon: from its corner `corner` to the next.
struct EdgeSide {
  int low, high;  ///< vertices in ascending order
  int facet;
  int corner;
  bool forward;  ///< whether the polygon has the edge from low to high
};

/// Return the sides of all edges, sorted by edge and polygon.
/// `facets` lists polygons or triangles, as vertex indices below `vertex_count`.
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
  // A counting sort by the lower vertex leaves few sides to sort per vertex.
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

/// Call `visit` with the sides of each edge, as a span.
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

/// Adjacency of the triangles of a closed, consistently oriented 2-manifold.
struct SurfaceTopology {
  /// Triangle across the edge from corner k to corner k + 1 of triangle t: neighbor[t][k].
  std::vector<std::array<TriangleIndex, 3>> neighbor;
  std::vector<int> shell;  ///< connected part of each triangle, counted from 0
  int shell_count = 0;
};

/// Compute the adjacency of triangles, and check that they form an oriented 2-manifold.
///
/// Each edge must have two triangles in opposite directions, and the triangles at each vertex must
/// form one fan.
/// @throws MeshError  kNotClosed, kNotManifold or kNotOriented, with the names of polygons and
///     vertices.
[[nodiscard]] SurfaceTopology ComputeTopology(const TriangleMesh& mesh, const std::string& name);

}  // namespace regrasp::object
