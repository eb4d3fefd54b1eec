#include <gtest/gtest.h>

#include "planner/search/switching_graph.h"
#include "tests/planner/search/subset_graph.h"

namespace regrasp::search {
namespace fewest_switches_test {

bool AdmitAll(int) { return true; }

/// Return distances from `start` by relaxing all edges until nothing changes.
std::vector<int> BruteForceDistances(const SwitchingGraph& graph, int start,
                                     const std::vector<bool>& admitted) {
  constexpr int kFar = 1'000'000;
  std::vector<int> distance(graph.vertex_count(), kFar);
  distance[start] = 0;
  std::vector<int> neighbours;
  for (bool changed = true; changed;) {
    changed = false;
    for (int v = 0; v < graph.vertex_count(); ++v) {
      if (distance[v] == kFar || (v != start && !admitted[v])) continue;
      graph.GetNeighbours(v, neighbours);
      for (const int n : neighbours) {
        if (distance[n] <= distance[v] + 1) continue;
        distance[n] = distance[v] + 1;
        changed = true;
      }
    }
  }
  std::replace(distance.begin(), distance.end(), kFar, -1);
  return distance;
}

TEST(FewestSwitches, AgreesWithBruteForceOnSparseSubsetGraphs) {
  std::mt19937 random(1);
  int paths = 0;
  int no_paths = 0;
  int detours = 0;
  for (int round = 0; round < 60; ++round) {
    const SubsetGraph graph = SubsetGraph::Random(9, 0.12, random);
    std::vector<bool> admitted(graph.vertex_count());
    for (int v = 0; v < graph.vertex_count(); ++v) admitted[v] = random() % 4 != 0;
    const auto admits = [&](int v) { return static_cast<bool>(admitted[v]); };
    const int start = static_cast<int>(random() % graph.vertex_count());
    const std::vector<int> expected = BruteForceDistances(graph, start, admitted);
    for (int goal = 0; goal < graph.vertex_count(); ++goal) {
      const int found = FewestSwitches(graph, start, goal, admits).value_or(-1);
      ASSERT_EQ(found, expected[goal]) << "round " << round << ", " << start << " to " << goal;
      ++(found < 0 ? no_paths : paths);
      if (found > graph.MinSwitches(start, goal)) ++detours;
    }
  }
  EXPECT_GT(paths, 100);
  EXPECT_GT(no_paths, 100);
  EXPECT_GT(detours, 100);
}

TEST(FewestSwitches, DoesNotAskTheFilterOfTheEnds) {
  const SubsetGraph chain({0b00001111, 0b00011110, 0b00111100});
  const auto only_the_middle = [](int v) { return v == 1; };
  EXPECT_EQ(FewestSwitches(chain, 0, 2, only_the_middle), 2);
  EXPECT_EQ(FewestSwitches(chain, 0, 2, [](int) { return false; }), std::nullopt);
  EXPECT_EQ(FewestSwitches(chain, 0, 1, [](int) { return false; }), 1);
  EXPECT_EQ(FewestSwitches(chain, 1, 1, [](int) { return false; }), 0);
}

TEST(FewestSwitches, EndsEarlyWhereTheGoalStandsAlone) {
  std::mt19937 random(2);
  std::vector<unsigned> sets = {0b1111u << 20};
  for (unsigned set = 0; set < (1u << 12); ++set) {
    if (std::popcount(set) == 4) sets.push_back(set);
  }
  const SubsetGraph graph(sets);
  int asked = 0;
  const auto count = [&](int) { return ++asked > 0; };
  EXPECT_EQ(FewestSwitches(graph, 1, 0, count), std::nullopt);
  EXPECT_LE(asked, 5);
}

TEST(ReachableVertices, AreThoseAtFiniteDistance) {
  std::mt19937 random(3);
  int checked = 0;
  for (int round = 0; round < 20; ++round) {
    const SubsetGraph graph = SubsetGraph::Random(9, 0.08, random);
    std::vector<int> reached = ReachableVertices(graph, 0, AdmitAll);
    std::sort(reached.begin(), reached.end());
    const std::vector<int> distance =
        BruteForceDistances(graph, 0, std::vector<bool>(graph.vertex_count(), true));
    std::vector<int> expected;
    for (int v = 0; v < graph.vertex_count(); ++v) {
      if (distance[v] >= 0) expected.push_back(v);
    }
    EXPECT_EQ(reached, expected);
    checked += static_cast<int>(reached.size());
  }
  EXPECT_GT(checked, 20);
}

}  // namespace fewest_switches_test
}  // namespace regrasp::search
