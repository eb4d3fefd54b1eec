#include "planner/repair/soup_shells.h"

#include <set>
#include <utility>
#include <vector>

namespace regrasp::repair {

bool HasOpenEdges(const object::PolygonSoup& soup) {
  std::set<std::pair<int, int>> edges;
  for (const auto& facet : soup.facets) {
    for (std::size_t k = 0; k < facet.size(); ++k) {
      const int from = facet[k], to = facet[(k + 1) % facet.size()];
      if (edges.erase({to, from}) == 0) edges.insert({from, to});
    }
  }
  return !edges.empty();
}

int CountShells(const object::PolygonSoup& soup) {
  std::vector<int> root(soup.vertices.size());
  for (int v = 0; v < std::ssize(root); ++v) root[v] = v;
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& facet : soup.facets) {
    for (const int v : facet) root[find(v)] = find(facet[0]);
  }
  int shells = 0;
  std::vector<bool> used(root.size(), false);
  for (const auto& facet : soup.facets) {
    const int v = find(facet[0]);
    shells += !used[v];
    used[v] = true;
  }
  return shells;
}

}  // namespace regrasp::repair
