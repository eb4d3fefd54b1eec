#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

namespace regrasp::object {

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

}  // namespace regrasp::object
