#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/sets/polygon/polygon_planner.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/peak_memory.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace graph_memory_test {

using ::testing::HasSubstr;

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer keeps freed memory
TEST(PolygonGraphMemory, TheEstimateIsWithinAFactorOfTwoOfWhatIsUsed) {
  struct Case {
    const char* file;
    double degrees;
    planning::Spanning spanning;
  };
  for (const auto& [file, degrees, spanning] :
       {Case{"polygon30.wkt", 30, planning::Spanning::kAdaptive},
        Case{"polygon35.wkt", 30, planning::Spanning::kAdaptive},
        Case{"polygon40.wkt", 20, planning::Spanning::kAdaptive},
        Case{"polygon40.wkt", 30, planning::Spanning::kAdaptive},
        Case{"polygon40.wkt", 30, planning::Spanning::kUniform},
        Case{"gear128.wkt", 5, planning::Spanning::kAdaptive}}) {
    const object::Polygon polygon = ReadPlanarModel(file);
    const double used = PeakBytesOf(
        [&] { static_cast<void>(MakeGraph(polygon, degrees, spanning).vertex_count()); });
    const double estimate = EstimatePolygonGraph(polygon, Radians(degrees), spanning).bytes();
    ASSERT_GT(used, 1e7) << file;
    EXPECT_GT(estimate, used / 2) << file << " at " << degrees;
    EXPECT_LT(estimate, used * 2) << file << " at " << degrees;
  }
}
#endif

TEST(PolygonGraphMemory, TheEstimateGrowsWithTheEdges) {
  double last = 0;
  for (const int n : {4, 7, 15, 31, 63, 127, 1001, 10'001}) {
    const MemoryNeed need =
        EstimatePolygonGraph(RegularPolygon(n), Radians(15.5), planning::Spanning::kAdaptive);
    EXPECT_EQ(need.count, n);
    EXPECT_GT(need.bytes(), last) << n;
    last = need.bytes();
  }
  EXPECT_GT(last, 1e12);
}

TEST(PolygonGraphMemory, APlanOnAGraphThatDoesNotFitIsNone) {
  const object::Polygon polygon = RegularPolygon(1001);
  planning::PlanRequest options = RequestAt(20);
  options.memory = 1e9;
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), polygon, Random(), Random(), options);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(result.message, HasSubstr("1001 edges require"));
}

}  // namespace graph_memory_test
}  // namespace regrasp::polygon
