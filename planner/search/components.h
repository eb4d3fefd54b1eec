#pragma once

#include <functional>
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

}  // namespace regrasp::search
