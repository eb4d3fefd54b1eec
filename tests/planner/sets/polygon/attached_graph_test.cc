#include "planner/sets/polygon/attached_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/search/fewest_switches.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp {
namespace {

std::vector<int> Neighbours(const SwitchingGraph& graph, int vertex) {
  std::vector<int> neighbours;
  graph.GetNeighbours(vertex, neighbours);
  return neighbours;
}

class AttachedBlob : public testing::Test {
 protected:
  AttachedBlob() : graph_(MakeGraph(blob_, 20, Spanning::kAdaptive)), cells_(blob_, graph_) {}

  /// The switches between a set of `start` and one of `goal`, and two for these.
  [[nodiscard]] std::optional<int> Switches(const std::vector<Attachment>& start,
                                            const std::vector<Attachment>& goal) const {
    const AttachedGraph graph(graph_, start, goal, banned_);
    return FewestSwitches(graph, graph.start(), graph.goal(), [](int) { return true; });
  }

  const Polygon& blob_ = SmallPolygons()[4].polygon;
  PolygonGraph graph_;
  GraphCells cells_;
  std::set<VertexPair> banned_;
};

TEST_F(AttachedBlob, NeighboursAreMutualAndDistinct) {
  banned_ = {{0, Neighbours(graph_, 0).front()}};
  const AttachedGraph graph(graph_, {{0, {}, true}, {1, {}, false}, {2, {}, false}},
                            {{2, {}, true}, {3, {}, true}}, banned_);
  int edges = 0;
  for (int v = 0; v < graph.vertex_count(); ++v) {
    const std::vector<int> neighbours = Neighbours(graph, v);
    const std::set<int> distinct(neighbours.begin(), neighbours.end());
    EXPECT_EQ(distinct.size(), neighbours.size());
    EXPECT_FALSE(distinct.contains(v));
    for (const int w : neighbours) {
      const std::vector<int> back = Neighbours(graph, w);
      EXPECT_NE(std::find(back.begin(), back.end(), v), back.end()) << v << " and " << w;
      ++edges;
    }
  }
  int of_graph = 0;
  for (int v = 0; v < graph_.vertex_count(); ++v) {
    of_graph += static_cast<int>(Neighbours(graph_, v).size());
  }
  // Without the banned one; five attachments, and the start before and after its own switch.
  EXPECT_EQ(edges, of_graph - 2 + 2 * 5 + 2);
}

TEST_F(AttachedBlob, AGraspIsOneSwitchFartherFromSetsThatItHasToSwitchTo) {
  EXPECT_EQ(Switches({{0, {}, true}}, {{0, {}, true}}), 2);
  EXPECT_EQ(Switches({{0, {}, false}}, {{0, {}, true}}), 3);
  EXPECT_EQ(Switches({{0, {}, false}}, {{0, {}, false}}), 4);
  EXPECT_EQ(Switches({{0, {}, false}, {0, {}, true}}, {{0, {}, true}}), 2);
}

TEST_F(AttachedBlob, BannedSwitchesAreNotTaken) {
  const int other = Neighbours(graph_, 0).front();
  EXPECT_EQ(Switches({{0, {}, true}}, {{other, {}, true}}), 3);
  banned_ = {Unordered(other, 0)};
  EXPECT_GT(Switches({{0, {}, true}}, {{other, {}, true}}), 3);
  for (const int neighbour : Neighbours(graph_, 0)) banned_.insert(Unordered(0, neighbour));
  EXPECT_FALSE(Switches({{0, {}, true}}, {{other, {}, true}}).has_value());
}

TEST_F(AttachedBlob, PathsAreOfSetsThatAreJoined) {
  int longest = 0;
  for (int goal = 0; goal < graph_.vertex_count(); ++goal) {
    const AttachedGraph graph(graph_, {{0, {}, true}}, {{goal, {}, false}}, banned_);
    const std::vector<int> path = FindSetPath(graph, cells_);
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front(), 0);
    EXPECT_EQ(path.back(), goal);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const std::vector<int> joined = Neighbours(graph_, path[i]);
      EXPECT_NE(std::find(joined.begin(), joined.end(), path[i + 1]), joined.end());
    }
    longest = std::max(longest, static_cast<int>(path.size()));
  }
  EXPECT_GT(longest, 2);
}

}  // namespace
}  // namespace regrasp
