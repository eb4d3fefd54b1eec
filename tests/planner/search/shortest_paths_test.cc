#include <gtest/gtest.h>

#include "planner/search/switching_graph.h"
#include "tests/planner/search/subset_graph.h"

namespace regrasp::search {
namespace shortest_paths_test {

/// Return distances from `start` by relaxing all edges until nothing changes; −1 if there is no
/// path.
std::vector<int> BruteForceDistances(const SwitchingGraph& graph, int start) {
  std::vector<int> distance(graph.vertex_count(), -1);
  distance[start] = 0;
  std::vector<int> neighbours;
  for (bool changed = true; changed;) {
    changed = false;
    for (int v = 0; v < graph.vertex_count(); ++v) {
      if (distance[v] < 0) continue;
      graph.GetNeighbours(v, neighbours);
      for (const int n : neighbours) {
        if (distance[n] >= 0 && distance[n] <= distance[v] + 1) continue;
        distance[n] = distance[v] + 1;
        changed = true;
      }
    }
  }
  return distance;
}

TEST(ShortestPaths, AreTheVerticesWhoseDistancesToBothEndsSumToTheFewestSwitches) {
  std::mt19937 random(1);
  int on_paths = 0;
  int beside = 0;
  int no_ways = 0;
  for (int round = 0; round < 60; ++round) {
    const SubsetGraph graph = SubsetGraph::Random(9, 0.2, random);
    const int start = static_cast<int>(random() % graph.vertex_count());
    const std::vector<int> from_start = BruteForceDistances(graph, start);
    for (int goal = 0; goal < graph.vertex_count(); ++goal) {
      const auto paths = FindShortestPaths(graph, start, goal);
      ASSERT_EQ(paths.has_value(), from_start[goal] >= 0) << "round " << round;
      if (!paths) {
        ++no_ways;
        continue;
      }
      ASSERT_EQ(paths->switches, from_start[goal]);
      const std::vector<int> from_goal = BruteForceDistances(graph, goal);
      for (int v = 0; v < graph.vertex_count(); ++v) {
        const bool on = from_start[v] >= 0 && from_start[v] + from_goal[v] == paths->switches;
        ASSERT_EQ(paths->depth[v], on ? from_start[v] : -1)
            << "round " << round << ", " << start << " to " << goal << " at " << v;
        ++(on ? on_paths : beside);
      }
    }
  }
  EXPECT_GT(on_paths, 1000);
  EXPECT_GT(beside, 1000);
  EXPECT_GT(no_ways, 50);
}

TEST(ShortestPaths, OfAVertexToItselfAreItself) {
  const SubsetGraph chain({0b00001111, 0b00011110, 0b00111100});
  const auto paths = FindShortestPaths(chain, 1, 1);
  ASSERT_TRUE(paths.has_value());
  EXPECT_EQ(paths->switches, 0);
  EXPECT_EQ(paths->depth, (std::vector<int>{-1, 0, -1}));
}

}  // namespace shortest_paths_test
}  // namespace regrasp::search
