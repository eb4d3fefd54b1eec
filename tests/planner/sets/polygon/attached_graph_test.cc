#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/search/switching_graph.h"
#include "planner/sets/candidate_search.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/set_graph.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace attached_graph_test {

sets::GraspEnds Ends(const std::vector<int>& of_itself, const std::vector<int>& by_switch) {
  return {{of_itself.begin(), of_itself.end()}, {by_switch.begin(), by_switch.end()}};
}

std::vector<int> Neighbours(const search::SwitchingGraph& graph, int vertex) {
  std::vector<int> neighbours;
  graph.GetNeighbours(vertex, neighbours);
  return neighbours;
}

class AttachedBlob : public testing::Test {
 protected:
  AttachedBlob()
      : graph_(MakeGraph(blob_, 20, planning::Spanning::kAdaptive)), cells_(blob_, graph_) {}

  /// Return the fewest switches between start and goal, plus two for the edges to their sets.
  [[nodiscard]] std::optional<int> Switches(const sets::GraspEnds& start,
                                            const sets::GraspEnds& goal) const {
    const sets::AttachedGraph graph(graph_, start, goal, banned_);
    return search::FewestSwitches(graph, graph.start(), graph.goal(), [](int) { return true; });
  }

  const object::Polygon& blob_ = SmallPolygons()[4].polygon;
  PolygonGraph graph_;
  GraphCells cells_;
  std::set<search::VertexPair> banned_;
};

TEST_F(AttachedBlob, NeighboursAreMutualAndDistinct) {
  banned_ = {{0, Neighbours(graph_, 0).front()}};
  const sets::AttachedGraph graph(graph_, Ends({0}, {1, 2}), Ends({2, 3}, {}), banned_);
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
  // Minus the banned edge, plus five attachments and the start's additional switch, in both
  // directions.
  EXPECT_EQ(edges, of_graph - 2 + 2 * 5 + 2);
}

TEST_F(AttachedBlob, AGraspIsOneSwitchFartherFromSetsThatItHasToSwitchTo) {
  EXPECT_EQ(Switches(Ends({0}, {}), Ends({0}, {})), 2);
  EXPECT_EQ(Switches(Ends({}, {0}), Ends({0}, {})), 3);
  EXPECT_EQ(Switches(Ends({}, {0}), Ends({}, {0})), 4);
  EXPECT_EQ(Switches(Ends({0}, {0}), Ends({0}, {})), 2);
}

TEST_F(AttachedBlob, BannedSwitchesAreNotTaken) {
  const int other = Neighbours(graph_, 0).front();
  EXPECT_EQ(Switches(Ends({0}, {}), Ends({other}, {})), 3);
  banned_ = {search::Unordered(other, 0)};
  EXPECT_GT(Switches(Ends({0}, {}), Ends({other}, {})), 3);
  for (const int neighbour : Neighbours(graph_, 0)) banned_.insert(search::Unordered(0, neighbour));
  EXPECT_FALSE(Switches(Ends({0}, {}), Ends({other}, {})).has_value());
}

TEST_F(AttachedBlob, PathsAreOfSetsThatAreJoined) {
  int longest = 0;
  for (int goal = 0; goal < graph_.vertex_count(); ++goal) {
    const sets::AttachedGraph graph(graph_, Ends({0}, {}), Ends({}, {goal}), banned_);
    std::vector<int> path = sets::FindWidePath(graph, graph.start(), graph.goal(), [&](int vertex) {
      return graph.IsSet(vertex) ? cells_.WidthOf(sets::SetIndex(vertex)) : 0;
    });
    std::erase_if(path, [&](int vertex) { return !graph.IsSet(vertex); });
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

TEST_F(AttachedBlob, ASetIsTheOnlyOneOfAnEndWhereNoOtherIsJoinedToIt) {
  const sets::AttachedGraph graph(graph_, Ends({0}, {}), Ends({1}, {2}), banned_);
  EXPECT_TRUE(graph.IsOnlySetOfAnEnd(0));
  for (const int other : {1, 2, 3}) EXPECT_FALSE(graph.IsOnlySetOfAnEnd(other)) << other;
}

}  // namespace attached_graph_test
}  // namespace regrasp::polygon
