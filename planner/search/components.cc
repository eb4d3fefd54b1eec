#include "planner/search/components.h"

#include <boost/pending/disjoint_sets.hpp>

namespace regrasp::search {

Components FindComponents(int vertex_count, int group_count,
                          const std::function<std::span<const int>(int group)>& members) {
  boost::disjoint_sets_with_storage<> sets(vertex_count);
  for (int group = 0; group < group_count; ++group) {
    const std::span<const int> vertices = members(group);
    for (const int vertex : vertices) sets.union_set(vertices.front(), vertex);
  }
  Components components;
  components.of_vertex.resize(vertex_count);
  std::vector<int> number(vertex_count, -1);
  for (int vertex = 0; vertex < vertex_count; ++vertex) {
    int& component = number[sets.find_set(vertex)];
    if (component < 0) {
      component = components.count();
      components.sizes.push_back(0);
    }
    components.of_vertex[vertex] = component;
    ++components.sizes[component];
  }
  return components;
}

}  // namespace regrasp::search
