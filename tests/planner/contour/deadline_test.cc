#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/contour/plan_contour.h"
#include "tests/planner/contour/outlines.h"
#include "tests/planner/counted_deadline.h"

namespace regrasp {
namespace {

using ::testing::HasSubstr;

TEST(ContourDeadline, TheGraphLooksAtItForEveryPieceAndEndsWhereverItComes) {
  const Polygon polygon = IrregularOutline(40, 0.8, 3);
  const CountedDeadline never;
  const ContourGraph graph(polygon, Radians(20), never.deadline());
  EXPECT_GE(never.looks(), graph.candidate_count() + std::ssize(graph.pieces()));
  for (int look = 1; look <= never.looks(); look += 1 + look / 10) {
    const CountedDeadline counted(look);
    EXPECT_THROW((void)ContourGraph(polygon, Radians(20), counted.deadline()), TimeUp) << look;
    EXPECT_EQ(counted.looks(), look);
  }
}

TEST(ContourDeadline, EndsAPlanWhereverItComes) {
  const Polygon polygon = IrregularOutline(60, 0.8, 3);
  const GraspChoice random = {GraspChoice::Kind::kRandom, {}, "random"};
  ContourPlanOptions options;
  options.half_angle = Radians(20);
  const CountedDeadline never;
  options.deadline = never.deadline();
  ASSERT_TRUE(PlanOnContour(polygon, random, random, options).plan);
  int ended = 0;
  for (int look = 1; look <= never.looks(); look += 1 + look / 5) {
    options.deadline = CountedDeadline(look).deadline();
    const PlanResult result = PlanOnContour(polygon, random, random, options);
    if (result.plan) continue;  // of a random goal that is not as good
    EXPECT_THAT(result.message, HasSubstr("the planner contour when the time was up"));
    ++ended;
  }
  EXPECT_GT(ended, 10);
}

}  // namespace
}  // namespace regrasp
