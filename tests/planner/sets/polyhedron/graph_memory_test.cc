#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/polyhedron_stone.h"
#include "planner/base/number.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/peak_memory.h"
#include "tests/fixtures/plan_with.h"

namespace regrasp::polyhedron {
namespace graph_memory_test {

using ::testing::HasSubstr;

const double kFrictionAngle = Radians(15);

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer keeps freed memory
TEST(PolyhedronGraphMemory, TheEstimateIsWithinAFactorOfTwoOfWhatIsUsed) {
  for (const char* file : {"body40.obj", "body47.obj", "body67.obj"}) {
    const object::Polyhedron solid = ReadSolidModel(file);
    const double used = PeakBytesOf([&] {
      static_cast<void>(
          PolyhedronGraph(solid, kFrictionAngle, planning::Spanning::kAdaptive).vertex_count());
    });
    const double estimate =
        EstimatePolyhedronGraph(solid, kFrictionAngle, planning::Spanning::kAdaptive).bytes();
    ASSERT_GT(used, 4e6) << file;
    EXPECT_GT(estimate, used / 2) << file;
    EXPECT_LT(estimate, used * 2) << file;
  }
}
#endif

TEST(PolyhedronGraphMemory, TheEstimateGrowsWithTheFaces) {
  double last = 0;
  for (const int n : {8, 16, 32, 64, 128, 256, 512}) {
    const MemoryNeed need = EstimatePolyhedronGraph(MakeStone(n, {1, 1.2, 0.8}, 1), kFrictionAngle,
                                                    planning::Spanning::kAdaptive);
    EXPECT_EQ(need.count, n);
    EXPECT_GT(need.bytes(), last) << n;
    last = need.bytes();
  }
  EXPECT_GT(last, 1e11);
}

TEST(PolyhedronGraphMemory, APlanOnAGraphThatDoesNotFitIsNone) {
  planning::PlanRequest options;
  options.criteria.friction_angle = kFrictionAngle;
  options.memory = 1e9;
  const planning::PlanResult result =
      PlanWith(PolyhedronPlanner(), MakeStone(300, {1, 1, 1}, 1), Random(), Random(), options);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(result.message, HasSubstr("300 faces require"));
}

}  // namespace graph_memory_test
}  // namespace regrasp::polyhedron
