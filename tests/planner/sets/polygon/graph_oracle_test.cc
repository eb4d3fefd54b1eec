// Comparison of concurrent grasp sets with exact Boolean operations on polygons.

#include "tests/planner/sets/polygon/graph_oracle.h"

#include <gtest/gtest.h>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace graph_oracle_test {

TEST(GraphOracle, CellsAndSwitchesOfSmallPolygonsAreThoseOfExactSetOperations) {
  OracleCount total;
  for (const auto& [name, polygon] : SmallPolygons()) {
    for (const double degrees : {5.0, 10.0, 20.0, 29.0, 35.0, 50.0}) {
      for (const planning::Spanning spanning : kSpannings) {
        const PolygonGraph graph = MakeGraph(polygon, degrees, spanning);
        std::string difference;
        total += CompareWithSetOperations(polygon, graph, Radians(degrees), spanning, difference);
        EXPECT_EQ(difference, "") << name << " at " << degrees << "°, " << Name(spanning);
      }
    }
  }
  EXPECT_GT(total.candidates, total.cells);
  EXPECT_GT(total.cells, 100);
  EXPECT_GT(total.switches, 100);
}

TEST(GraphOracle, NoticesAnotherFrictionAnotherSpanningAndAnotherPolygon) {
  const object::Polygon& ring = SmallPolygons().back().polygon;
  const PolygonGraph graph = MakeGraph(ring, 10, planning::Spanning::kUniform);
  const object::Polygon moved = object::Polygon::FromRings(
      {{{0, 0}, {5, 0.6}, {5.4, 4.2}, {3.2, 4.9}, {-0.4, 2.4}}, ring.rings()[1]}, "moved");
  std::string difference;
  EXPECT_GT(
      CompareWithSetOperations(ring, graph, Radians(10), planning::Spanning::kUniform, difference)
          .cells,
      0);
  EXPECT_EQ(difference, "");
  EXPECT_GT(
      CompareWithSetOperations(ring, graph, Radians(12), planning::Spanning::kUniform, difference)
          .cells,
      0);
  EXPECT_NE(difference, "");
  EXPECT_GT(
      CompareWithSetOperations(ring, graph, Radians(10), planning::Spanning::kAdaptive, difference)
          .cells,
      0);
  EXPECT_NE(difference, "");
  EXPECT_GT(
      CompareWithSetOperations(moved, graph, Radians(10), planning::Spanning::kUniform, difference)
          .cells,
      0);
  EXPECT_NE(difference, "");
}

}  // namespace graph_oracle_test
}  // namespace regrasp::polygon
