#include <gtest/gtest.h>

#include "planner/search/switching_graph.h"
#include "tests/planner/search/subset_graph.h"

namespace regrasp::search {
namespace components_test {

Components Find(int vertices, const std::vector<std::vector<int>>& groups) {
  return FindComponents(vertices, static_cast<int>(groups.size()),
                        [&](int group) { return std::span<const int>(groups[group]); });
}

TEST(FindComponents, JoinsAllVerticesOfAGroup) {
  const Components components = Find(7, {{0, 3, 5}, {}, {1, 2}, {5, 6}, {4}});
  EXPECT_EQ(components.count(), 3);
  EXPECT_EQ(components.of_vertex, (std::vector<int>{0, 1, 1, 0, 2, 0, 0}));
  EXPECT_EQ(components.sizes, (std::vector<int>{4, 2, 1}));
}

TEST(FindComponents, HasNoneWithoutVerticesAndOneEachWithoutGroups) {
  EXPECT_EQ(Find(0, {}).count(), 0);
  EXPECT_EQ(Find(3, {}).count(), 3);
}

TEST(FindComponents, AgreesWithFloods) {
  std::mt19937 random(5);
  int split = 0;
  for (int round = 0; round < 20; ++round) {
    const SubsetGraph graph = SubsetGraph::Random(9, 0.06, random);
    std::vector<std::vector<int>> edges;
    std::vector<int> neighbours;
    for (int v = 0; v < graph.vertex_count(); ++v) {
      graph.GetNeighbours(v, neighbours);
      for (const int n : neighbours) edges.push_back({v, n});
    }
    const Components components = Find(graph.vertex_count(), edges);
    for (int v = 0; v < graph.vertex_count(); ++v) {
      const std::vector<int> reached = ReachableVertices(graph, v, [](int) { return true; });
      EXPECT_EQ(components.sizes[components.of_vertex[v]], static_cast<int>(reached.size()));
      for (const int other : reached) {
        EXPECT_EQ(components.of_vertex[other], components.of_vertex[v]);
      }
    }
    if (components.count() > 1) ++split;
  }
  EXPECT_GT(split, 5);
}

}  // namespace components_test
}  // namespace regrasp::search
