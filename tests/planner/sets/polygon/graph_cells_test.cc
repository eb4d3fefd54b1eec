#include "planner/sets/polygon/graph_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/grasp/force_closure.h"
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
}  // namespace regrasp::polygon
