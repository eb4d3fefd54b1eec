#include "planner/sets/polygon/graph_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "planner/grasp/force_closure.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "tests/fixtures/edge_grasp.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace graph_cells_test {

TEST(GraphCells, DrawsGraspsAllOverASet) {
  const object::Polygon square = Square(1);
  const PolygonGraph graph = MakeGraph(square, 40, planning::Spanning::kAdaptive);
  GraphCells cells(square, graph);
  const sets::SetIndex vertex = graph.SetsOn(Edges({0, 2})).front();
  RandomStream random(1, RandomUse::kStart);
  // Pairs of quarters of both edges that the contacts reach: all except those beyond the friction
  // angle.
  std::set<std::pair<int, int>> hit;
  for (int i = 0; i < 500; ++i) {
    const grasp::Grasp grasp = cells.GraspOf(*cells.Draw(vertex, random));
    ASSERT_EQ(grasp.size(), 2U);
    EXPECT_TRUE(grasp::IsForceClosure(grasp, square.wrench_frame(), Radians(40)));
    hit.emplace(static_cast<int>(4 * grasp::ParameterOf(square, grasp[0])),
                static_cast<int>(4 * grasp::ParameterOf(square, grasp[1])));
  }
  EXPECT_EQ(hit.size(), 16U);
}

TEST(GraphCells, DrawsTheSameGraspsFromTheSameSeed) {
  const object::Polygon& blob = SmallPolygons()[4].polygon;
  const PolygonGraph graph = MakeGraph(blob, 20, planning::Spanning::kAdaptive);
  const auto draw = [&](std::uint64_t seed) {
    GraphCells cells(blob, graph);
    RandomStream random(seed, RandomUse::kStart);
    return cells.GraspOf(*cells.Draw(sets::SetIndex(0), random)).front().p;
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

TEST(GraphCells, AttachWholeGraspsAndPartsOfThem) {
  const object::Polygon square = Square(1);
  const PolygonGraph graph = MakeGraph(square, 20, planning::Spanning::kAdaptive);
  GraphCells cells(square, graph);
  const sets::SetIndex upright = graph.SetsOn(Edges({0, 2})).front();
  const sets::SetIndex level = graph.SetsOn(Edges({1, 3})).front();
  const auto attach = [&](const std::vector<std::pair<int, double>>& places) {
    return cells.FindAttachments(MakeGrasp(square, places));
  };
  const std::vector<sets::Attachment<PolygonPlace>> pair = attach({{2, 0.6}, {0, 0.5}});
  ASSERT_EQ(pair.size(), 1U);
  EXPECT_EQ(pair[0].place.set, upright);
  EXPECT_TRUE(pair[0].whole);
  EXPECT_NEAR((pair[0].place.parameters - Eigen::Vector2d(0.5, 0.6)).norm(), 0, 1e-15);
  const std::vector<sets::Attachment<PolygonPlace>> four =
      attach({{0, 0.5}, {1, 0.5}, {2, 0.5}, {3, 0.5}});
  ASSERT_EQ(four.size(), 2U);
  EXPECT_EQ((std::set{four[0].place.set, four[1].place.set}), (std::set{upright, level}));
  EXPECT_FALSE(four[0].whole || four[1].whole);
  EXPECT_TRUE(attach({{0, 0.2}, {2, 0.2}}).empty());
}

TEST(GraphCells, SwitchesOfItsOwnLeadAnyGraspThatAHandCanKeepToTheSets) {
  const object::Polygon square = Square(1);
  const PolygonGraph graph = MakeGraph(square, 20, planning::Spanning::kAdaptive);
  GraphCells cells(square, graph);
  // The grasp is inclined by 31°. A new contact opposite either contact makes a pair, and so do two
  // new ones.
  const grasp::Grasp leaning = MakeGrasp(square, {{0, 0.2}, {2, 0.2}});
  const std::vector<sets::Attachment<PolygonPlace>> found =
      cells.FindSwitches(leaning, hand::kFingersInPlane);
  ASSERT_EQ(found.size(), 4U);
  std::set<int> vertices;
  for (const auto& attachment : found) {
    EXPECT_FALSE(attachment.whole);
    EXPECT_TRUE(IsInSet(cells.of(attachment.place.set), attachment.place.parameters));
    vertices.insert(attachment.place.set);
  }
  EXPECT_EQ(vertices.size(), 2U);
  // A hand of three fingers must keep one contact; a hand of two has no free finger.
  EXPECT_EQ(cells.FindSwitches(leaning, 3).size(), 2U);
  EXPECT_TRUE(cells.FindSwitches(leaning, 2).empty());
}

}  // namespace graph_cells_test

namespace switch_point_test {

std::vector<FaceIndex> CommonEdges(const GraspSet& a, const GraspSet& b) {
  std::vector<FaceIndex> common;
  std::set_intersection(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(),
                        std::back_inserter(common));
  return common;
}

/// Check that a hand of four fingers can execute the switch: both grasps are in their sets, and
/// kept contacts are equal.
void ExpectFeasible(const SwitchSide& from, const SwitchSide& to, const SwitchPoint& point) {
  EXPECT_TRUE(IsInSet(*from.cells, point.before));
  EXPECT_TRUE(IsInSet(*to.cells, point.after));
  EXPECT_LE(point.before.size() + point.after.size() - static_cast<int>(point.kept.size()),
            hand::kFingersInPlane);
  for (const FaceIndex edge : point.kept) {
    const auto parameter = [&](const SwitchSide& side, const Eigen::VectorXd& parameters) {
      const std::vector<FaceIndex>& edges = side.set->edges;
      return parameters[std::find(edges.begin(), edges.end(), edge) - edges.begin()];
    };
    EXPECT_EQ(parameter(from, point.before), parameter(to, point.after));
  }
}

struct SwitchCount {
  std::array<std::array<int, kGraspTypes>, kGraspTypes> found{};
  int none = 0;
};

/// Return whether the graph decides exactly whether any grasps of two sets can switch.
///
/// It does if a 2-finger set has a common edge with another set, or if two sets, one of them
/// parallel, have two common edges. Concurrent sets are not connected if only different focus
/// points see the common contacts.
bool GraphDecides(const GraspSet& a, const GraspSet& b) {
  const auto is = [&](GraspType type) { return a.type == type || b.type == type; };
  const auto common = CommonEdges(a, b).size();
  if (is(GraspType::kTwoFinger)) return common > 0;
  return is(GraspType::kParallel) && common == 2;
}

void CheckSwitches(const object::Polygon& polygon, double degrees, SwitchCount& count) {
  const PolygonGraph graph = MakeGraph(polygon, degrees, planning::Spanning::kAdaptive);
  GraphCells cells(polygon, graph);
  std::vector<int> neighbours;
  for (sets::SetIndex v{0}; v < graph.vertex_count(); ++v) {
    graph.GetNeighbours(v, neighbours);
    const std::set<int> joined(neighbours.begin(), neighbours.end());
    for (sets::SetIndex w{0}; w < graph.vertex_count(); ++w) {
      const GraspSet& a = graph.sets()[v];
      const GraspSet& b = graph.sets()[w];
      if (v == w || (!joined.contains(w) && !GraphDecides(a, b))) continue;
      const SwitchSide from = {&a, &cells.of(v), std::nullopt};
      const SwitchSide to = {&b, &cells.of(w), std::nullopt};
      const std::vector<SwitchPoint> points = FindSwitchPoints(from, to, hand::kFingersInPlane);
      EXPECT_EQ(!points.empty(), joined.contains(w)) << "vertices " << v << " and " << w;
      for (const SwitchPoint& point : points) ExpectFeasible(from, to, point);
      if (points.empty()) {
        ++count.none;
      } else {
        ++count.found[static_cast<int>(a.type)][static_cast<int>(b.type)];
      }
    }
  }
}

TEST(SwitchPoint, IsFoundWhereTheGraphHasASwitchAndNowhereElse) {
  SwitchCount count;
  for (const auto& [name, polygon] : SmallPolygons()) {
    SCOPED_TRACE(name);
    for (const double degrees : {15.0, 25.0}) CheckSwitches(polygon, degrees, count);
  }
  for (const auto& row : count.found) {
    for (const int found : row) EXPECT_GT(found, 10);
  }
  EXPECT_GT(count.none, 10);
}

/// The square's 2-finger sets on opposite sides.
class AcrossTheSquare : public testing::Test {
 protected:
  AcrossTheSquare()
      : graph_(MakeGraph(square_, 30, planning::Spanning::kAdaptive)), cells_(square_, graph_) {}

  SwitchSide Side(const std::vector<int>& edges) {
    const sets::SetIndex vertex = graph_.SetsOn(Edges(edges)).front();
    return {&graph_.sets()[vertex], &cells_.of(vertex), std::nullopt};
  }

  object::Polygon square_ = Square(1);
  PolygonGraph graph_;
  GraphCells cells_;
};

TEST_F(AcrossTheSquare, PlacesTwoFingersAndReleasesTwo) {
  const std::vector<SwitchPoint> points =
      FindSwitchPoints(Side({0, 2}), Side({1, 3}), hand::kFingersInPlane);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_TRUE(points.front().kept.empty());
  // Three fingers would have to keep a contact, but there is no common edge.
  EXPECT_TRUE(FindSwitchPoints(Side({0, 2}), Side({1, 3}), 3).empty());
}

TEST_F(AcrossTheSquare, StartsFromTheGraspAtHand) {
  SwitchSide from = Side({0, 2});
  from.fixed = Eigen::Vector2d(0.25, 0.7);
  const std::vector<SwitchPoint> points =
      FindSwitchPoints(from, Side({1, 3}), hand::kFingersInPlane);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points.front().before, *from.fixed);
  from.fixed = Eigen::Vector2d(0.1, 0.1);  // inclined by more than 30°
  EXPECT_TRUE(FindSwitchPoints(from, Side({1, 3}), hand::kFingersInPlane).empty());
}

/// Return a score that increases with the distance of contacts from the starts of their edges.
double ScoreByPosition(const GraspSet&, const Eigen::VectorXd& parameters) {
  return parameters.mean();
}

TEST_F(AcrossTheSquare, ImprovingRaisesTheScoreInsideTheSets) {
  const SwitchSide from = Side({0, 2});
  const SwitchSide to = Side({1, 3});
  const SwitchPoint point = FindSwitchPoints(from, to, hand::kFingersInPlane).front();
  const SwitchPoint better = ImproveSwitch(from, to, point, ScoreByPosition);
  ExpectFeasible(from, to, better);
  EXPECT_NEAR(ScoreOf(from, to, point, ScoreByPosition), 0.5, 1e-9);
  // Opposite edges have opposite directions, so the sum of both parameters is within 1 ± tan 30°.
  EXPECT_GT(ScoreOf(from, to, better, ScoreByPosition), 0.65);
  EXPECT_LT(ScoreOf(from, to, better, ScoreByPosition), 0.79);
  // Both grasps keep some slack.
  for (const auto& [side, parameters] :
       {std::pair(&from, &better.before), std::pair(&to, &better.after)}) {
    EXPECT_TRUE(IsInSet(*side->cells, *parameters, point.slack / 5));
  }
}

TEST(ImproveSwitch, MovesKeptContactsTogether) {
  const NamedPolygon& blob = SmallPolygons()[4];
  const PolygonGraph graph = MakeGraph(blob.polygon, 25, planning::Spanning::kAdaptive);
  GraphCells cells(blob.polygon, graph);
  std::vector<int> neighbours;
  int kept = 0;
  int improved = 0;
  for (int v = 0; v < graph.vertex_count(); v += 5) {
    graph.GetNeighbours(v, neighbours);
    for (const int w : neighbours) {
      const SwitchSide from = {&graph.sets()[v], &cells.of(sets::SetIndex(v)), std::nullopt};
      const SwitchSide to = {&graph.sets()[w], &cells.of(sets::SetIndex(w)), std::nullopt};
      const SwitchPoint point = FindSwitchPoints(from, to, hand::kFingersInPlane).front();
      const SwitchPoint better = ImproveSwitch(from, to, point, ScoreByPosition);
      ExpectFeasible(from, to, better);
      EXPECT_EQ(better.kept, point.kept);
      const double gain =
          ScoreOf(from, to, better, ScoreByPosition) - ScoreOf(from, to, point, ScoreByPosition);
      EXPECT_GE(gain, 0);
      kept += static_cast<int>(point.kept.size());
      improved += gain > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(improved, 100);
}

TEST_F(AcrossTheSquare, ImprovingNeverLowersTheScoreAndEnds) {
  const SwitchSide from = Side({0, 2});
  const SwitchSide to = Side({1, 3});
  const SwitchPoint point = FindSwitchPoints(from, to, hand::kFingersInPlane).front();
  for (const double constant : {-0.5, 0.0, 0.5}) {
    const GraspScore score = [&](const GraspSet&, const Eigen::VectorXd&) { return constant; };
    EXPECT_EQ(ImproveSwitch(from, to, point, score).before, point.before);
  }
  const GraspScore worst_at_first = [](const GraspSet&, const Eigen::VectorXd& parameters) {
    return -1 - std::abs(parameters[0] - 0.5);
  };
  EXPECT_GE(ScoreOf(from, to, ImproveSwitch(from, to, point, worst_at_first), worst_at_first),
            ScoreOf(from, to, point, worst_at_first));
}

}  // namespace switch_point_test
}  // namespace regrasp::polygon
