#include <gtest/gtest.h>

#include <limits>

#include "planner/search/switching_graph.h"
#include "tests/planner/search/subset_graph.h"

namespace regrasp::search {
namespace widest_path_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Graph with a filter and widths, and a brute-force search over all paths.
struct Instance {
  SubsetGraph graph;
  std::vector<bool> admitted;
  std::vector<double> width;

  static Instance Random(std::mt19937& random) {
    Instance instance{SubsetGraph::Random(8, 0.35, random), {}, {}};
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int v = 0; v < instance.graph.vertex_count(); ++v) {
      instance.admitted.push_back(uniform(random) < 0.8);
      instance.width.push_back(uniform(random));
    }
    return instance;
  }

  /// Return the largest bottleneck over all paths of `switches` more switches; −∞ if there is none.
  [[nodiscard]] double BruteForce(int vertex, int goal, int switches) const {
    if (switches == 0) return vertex == goal ? kInfinity : -kInfinity;
    double best = -kInfinity;
    std::vector<int> neighbours;
    graph.GetNeighbours(vertex, neighbours);
    for (const int next : neighbours) {
      const bool last = switches == 1;
      if (last != (next == goal) || (!last && !admitted[next])) continue;
      const double own = last ? kInfinity : width[next];
      best = std::max(best, std::min(own, BruteForce(next, goal, switches - 1)));
    }
    return best;
  }

  [[nodiscard]] double Bottleneck(const std::vector<int>& path) const {
    double bottleneck = kInfinity;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      bottleneck = std::min(bottleneck, width[path[i]]);
    }
    return bottleneck;
  }
};

TEST(WidestPath, AgreesWithTryingEverySequence) {
  std::mt19937 random(4);
  int checked = 0;
  int narrower_exists = 0;
  for (int round = 0; round < 200; ++round) {
    const Instance instance = Instance::Random(random);
    const int start = static_cast<int>(random() % instance.graph.vertex_count());
    const int goal = static_cast<int>(random() % instance.graph.vertex_count());
    const auto admits = [&](int v) { return static_cast<bool>(instance.admitted[v]); };
    const auto width = [&](int v) { return instance.width[v]; };
    const auto switches = FewestSwitches(instance.graph, start, goal, admits);
    if (!switches || *switches > 6) continue;
    const std::vector<int> path = WidestPath(instance.graph, start, goal, *switches, admits, width);
    ASSERT_EQ(static_cast<int>(path.size()), *switches + 1) << "round " << round;
    EXPECT_EQ(path.front(), start);
    EXPECT_EQ(path.back(), goal);
    for (std::size_t i = 1; i < path.size(); ++i) {
      EXPECT_EQ(instance.graph.MinSwitches(path[i - 1], path[i]), 1);
      EXPECT_TRUE(i + 1 == path.size() || instance.admitted[path[i]]);
    }
    EXPECT_EQ(instance.Bottleneck(path), instance.BruteForce(start, goal, *switches));
    const auto reversed = [&](int v) { return -instance.width[v]; };
    const std::vector<int> other =
        WidestPath(instance.graph, start, goal, *switches, admits, reversed);
    if (instance.Bottleneck(other) < instance.Bottleneck(path)) ++narrower_exists;
    ++checked;
  }
  EXPECT_GT(checked, 150);
  EXPECT_GT(narrower_exists, 50);
}

TEST(WidestPath, DoesNotAskTheEnds) {
  const SubsetGraph chain({0b00001111, 0b00011110, 0b00111100});
  const auto inner = [](int v) {
    EXPECT_EQ(v, 1);
    return true;
  };
  const auto width = [](int v) {
    EXPECT_EQ(v, 1);
    return 0.5;
  };
  EXPECT_EQ(WidestPath(chain, 0, 2, 2, inner, width), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(WidestPath(chain, 0, 1, 1, inner, width), (std::vector<int>{0, 1}));
  EXPECT_EQ(WidestPath(chain, 0, 0, 0, inner, width), (std::vector<int>{0}));
}

TEST(WidestPath, IsEmptyWhereNoSequenceHasThatManySwitches) {
  const SubsetGraph chain({0b00001111, 0b00011110, 0b00111100});
  const auto all = [](int) { return true; };
  const auto width = [](int) { return 1.0; };
  EXPECT_TRUE(WidestPath(chain, 0, 2, 1, all, width).empty());
  EXPECT_TRUE(WidestPath(
                  chain, 0, 2, 2, [](int) { return false; }, width)
                  .empty());
  EXPECT_FALSE(WidestPath(chain, 0, 2, 2, all, width).empty());
}

}  // namespace widest_path_test
}  // namespace regrasp::search
