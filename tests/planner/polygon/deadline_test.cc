#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/polygon/plan_polygon.h"
#include "tests/planner/counted_deadline.h"
#include "tests/planner/polygon/shapes.h"

namespace regrasp {
namespace {

using ::testing::HasSubstr;

TEST(PolygonDeadline, TheGraphLooksAtItForEveryCandidateAndEndsWhereverItComes) {
  const Polygon polygon = RegularPolygon(9);
  const CountedDeadline never;
  const PolygonGraph graph(polygon, Radians(20), Spanning::kAdaptive, never.deadline());
  std::int64_t candidates = 0;
  for (int type = 0; type < kGraspTypes; ++type) {
    candidates += graph.counts(static_cast<GraspType>(type)).candidates;
  }
  EXPECT_GE(never.looks(), candidates + graph.vertex_count());
  for (int look = 1; look <= never.looks(); look += 1 + look / 10) {
    const CountedDeadline counted(look);
    EXPECT_THROW((void)PolygonGraph(polygon, Radians(20), Spanning::kAdaptive, counted.deadline()),
                 TimeUp)
        << look;
    EXPECT_EQ(counted.looks(), look);
  }
}

TEST(PolygonDeadline, EndsAPlanWhereverItComes) {
  const Polygon polygon = RegularPolygon(9);
  PolygonPlanOptions options;
  options.half_angle = Radians(20);
  const GraspChoice start = {GraspChoice::Kind::kRandom, {}, "start"};
  const GraspChoice goal = {GraspChoice::Kind::kRandomAny, {}, "goal"};
  const CountedDeadline never;
  options.deadline = never.deadline();
  ASSERT_TRUE(PlanOnPolygon(polygon, start, goal, options).plan);
  int ended = 0;
  for (int look = 1; look <= never.looks(); look += 1 + look / 5) {
    options.deadline = CountedDeadline(look).deadline();
    const PlanResult result = PlanOnPolygon(polygon, start, goal, options);
    if (result.plan) continue;  // over weaker grasps
    EXPECT_THAT(result.message, HasSubstr("the planner polygon when the time was up"));
    ++ended;
  }
  EXPECT_GT(ended, 10);
}

}  // namespace
}  // namespace regrasp
