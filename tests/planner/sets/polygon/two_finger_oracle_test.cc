// Comparison of 2-finger sets and their switches to concurrent sets with exact clipping.

#include "tests/planner/sets/polygon/two_finger_oracle.h"

#include <gtest/gtest.h>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace two_finger_oracle_test {

TEST(TwoFingerOracle, SetsAndSwitchesOfSmallPolygonsAreThoseOfExactClipping) {
  TwoFingerCount total;
  for (const auto& [name, polygon] : SmallPolygons()) {
    for (const double degrees : {5.0, 10.0, 20.0, 35.0, 50.0}) {
      for (const planning::Spanning spanning : kSpannings) {
        const PolygonGraph graph = MakeGraph(polygon, degrees, spanning);
        std::string difference;
        const TwoFingerCount count =
            CompareTwoFingerSets(polygon, graph, Radians(degrees), difference);
        EXPECT_EQ(difference, "") << name << " at " << degrees << "°, " << Name(spanning);
        total.candidates += count.candidates;
        total.sets += count.sets;
        total.switches += count.switches;
      }
    }
  }
  EXPECT_GT(total.candidates, total.sets);
  EXPECT_GT(total.sets, 200);
  EXPECT_GT(total.switches, 500);
}

TEST(TwoFingerOracle, NoticesAnotherFriction) {
  const object::Polygon& blob = SmallPolygons()[4].polygon;
  std::string difference;
  EXPECT_GT(CompareTwoFingerSets(blob, MakeGraph(blob, 20, planning::Spanning::kUniform),
                                 Radians(25), difference)
                .sets,
            0);
  EXPECT_NE(difference, "");
}

}  // namespace two_finger_oracle_test
}  // namespace regrasp::polygon
