#include "planner/repair/soup_shells.h"

#include <algorithm>
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

std::vector<int> ShellOfFacets(const object::PolygonSoup& soup) {
  std::vector<int> root(soup.vertices.size());
  for (int v = 0; v < std::ssize(root); ++v) root[v] = v;
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& facet : soup.facets) {
    for (const int v : facet) root[find(v)] = find(facet[0]);
  }
  std::vector<int> number(root.size(), -1);
  std::vector<int> shells;
  int count = 0;
  for (const auto& facet : soup.facets) {
    int& shell = number[find(facet[0])];
    if (shell < 0) shell = count++;
    shells.push_back(shell);
  }
  return shells;
}

int CountShells(const object::PolygonSoup& soup) {
  const std::vector<int> shells = ShellOfFacets(soup);
  return shells.empty() ? 0 : 1 + *std::ranges::max_element(shells);
}

}  // namespace regrasp::repair
