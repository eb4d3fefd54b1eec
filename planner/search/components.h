#pragma once

#include <array>
#include <functional>
#include <iterator>
#include <span>
#include <vector>

namespace regrasp::search {

/// The connected components of a graph.
struct Components {
  std::vector<int> of_vertex;  ///< numbered from 0 in the order of their first vertices
  std::vector<int> sizes;      ///< vertices of each
  [[nodiscard]] int count() const { return static_cast<int>(sizes.size()); }
};

/// Components where all vertices of a group are joined to each other. A group of two is an edge; a
/// larger one spares its edges (all grasps that contain the same three contacts, say).
/// @param members  the vertices of a group.
[[nodiscard]] Components FindComponents(
    int vertex_count, int group_count,
    const std::function<std::span<const int>(int group)>& members);

/// Components of a graph with these edges. @param ends  gives an edge's two vertices.
template <class Edges, class Ends = std::identity>
[[nodiscard]] Components ComponentsOfEdges(int vertex_count, const Edges& edges,
                                           const Ends& ends = {}) {
  std::array<int, 2> pair;
  return FindComponents(vertex_count, static_cast<int>(std::ssize(edges)), [&](int edge) {
    const auto& [a, b] = std::invoke(ends, edges[edge]);
    pair = {a, b};
    return std::span<const int>(pair);
  });
}

}  // namespace regrasp::search
