#include "planner/registry/plan_auto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/angle.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/set_cells.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Polygon Disc(int edges) {
  std::vector<Eigen::Vector2d> ring;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * k / edges;
    ring.emplace_back(std::cos(angle), std::sin(angle));
  }
  return Polygon::FromRings({ring}, "disc");
}

/// On opposite edges of a disc of an even number of them.
GraspChoice Pinch(const Polygon& disc, int edge) {
  const int half = disc.face_count() / 2;
  return {GraspChoice::Kind::kGiven,
          {ContactAt(disc, edge, 0.5), ContactAt(disc, edge + half, 0.5)},
          "pinch"};
}

PlanResult PlanAcross(int edges) {
  const Polygon disc = Disc(edges);
  AutoPlanOptions options;
  options.general.half_angle = Radians(15);
  return PlanAuto(disc, Pinch(disc, 0), Pinch(disc, edges / 4), options);
}

TEST(PlanAutoTest, APolygonOfManyEdgesIsForTheGeneralPlanner) {
  const PlanResult few = PlanAcross(100);
  ASSERT_TRUE(few.plan.has_value());
  EXPECT_EQ(few.plan->planner, "contour");
  const PlanResult many = PlanAcross(3002);
  ASSERT_TRUE(many.plan.has_value());
  EXPECT_EQ(many.plan->planner, "general");
  EXPECT_THAT(many.notes, Contains(HasSubstr("contour is for polygons of at most 3000 edges")));
}

TEST(PlanAutoTest, AGraphThatDoesNotFitIsLeftToTheGeneralPlanner) {
  const ObjectFile stone = ReadModel("stone.obj");
  const GraspChoice random{GraspChoice::Kind::kRandomAny, {}, "--start random"};
  AutoPlanOptions options;
  options.general.half_angle = Radians(25);
  const PlanResult ample = PlanAuto(*stone.object, random, random, options);
  options.memory = 1;
  const PlanResult scarce = PlanAuto(*stone.object, random, random, options);
  ASSERT_TRUE(ample.plan && scarce.plan);
  EXPECT_EQ(scarce.plan->planner, "general");
  const auto is_told = Contains(HasSubstr("the graph of the planner polyhedron takes"));
  EXPECT_THAT(scarce.notes, is_told);
  EXPECT_THAT(ample.notes, Not(is_told));
}

TEST(PlanAutoTest, ExactPlannersEndAtTheDeadline) {
  const Polygon disc = Disc(100);
  AutoPlanOptions options;
  options.general.half_angle = Radians(15);
  options.general.deadline = Deadline::Clock::now();
  const PlanResult result = PlanAuto(disc, Pinch(disc, 0), Pinch(disc, 25), options);
  const std::string said = result.plan ? result.notes.front() : result.message;
  EXPECT_THAT(said, HasSubstr("no sequence was found by the planner polygon when the time was up"));
}

}  // namespace
}  // namespace regrasp
