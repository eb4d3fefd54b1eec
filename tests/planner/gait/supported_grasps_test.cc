#include "planner/gait/supported_grasps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "gait_requests.h"
#include "gait_world.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/check.h"
#include "planner/plan/gravity_support.h"

namespace regrasp::gait {
namespace supported_grasps_test {

constexpr double kScale = 0.8;

TEST(SupportedGraspsTest, AGraspHoldsIfItIsForceClosureOrGravitySupported) {
  GaitWorld world(RequestFor("cube", kScale, 90));
  const criteria::GraspMemory& memory = world.memory;
  const plan::WeightCarrier carrier(memory.frame(), memory.friction_angle(), {},
                                    world.scene.hand().up);
  const PoseGrid grid(world.task.From(world.BestPose()), world.scene.hand().up,
                      PoseGrid::End::kOrientation);
  HandSetup with = world.setup;
  with.carrier = &carrier;
  SupportedGrasps supported(with, grid, world.memory);
  SupportedGrasps only_closed(world.setup, grid, world.memory);
  RandomStream random(3, RandomUse::kGaits);
  int closed = 0;
  int by_weight = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    ContactAssignment assignment = random.Choose(kWorldContacts, 3);
    criteria::ContactSet set;
    for (const int point : assignment) set.Insert(point);
    const bool is_closed = world.memory.Admits(set);
    const bool is_carried = carrier.HoldsAt(memory.GraspOf(set), grid.PoseAt(grid.start()));
    EXPECT_EQ(supported.Holds(set, grid.start()), is_closed || is_carried);
    EXPECT_EQ(supported.Holds(assignment, grid.start()), is_closed || is_carried);
    EXPECT_EQ(only_closed.Holds(set, grid.start()), is_closed);
    closed += static_cast<int>(is_closed);
    by_weight += static_cast<int>(is_carried && !is_closed);
  }
  EXPECT_GT(closed, 0);
  EXPECT_GT(by_weight, 0);
}

TEST(SupportedGraspsTest, PlansOfTheRequestRecordItAndPassTheCheck) {
  GaitRequest request = RequestFor("cube", kScale, 90);
  request.robustness = RobustnessLevel::kNone;
  for (const bool gravity : {false, true}) {
    request.gravity_support = gravity ? std::optional(plan::GravitySupport()) : std::nullopt;
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_EQ(plan.hand->gravity_support.has_value(), gravity);
    EXPECT_EQ(plan.hand->up.has_value(), gravity);
    EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
  }
}

/// No grasp has the required quality, but fingers below the cube carry it.
TEST(SupportedGraspsTest, GravityHoldsIfNoGraspIsGoodEnough) {
  GaitRequest request = RequestFor("cube", 0.5, 20);
  request.robustness = RobustnessLevel::kNone;
  request.criteria.friction_angle = std::atan(0.3);
  request.criteria.min_quality = 0.9;
  EXPECT_FALSE(FindGait(request).gait);
  request.gravity_support.emplace();
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  const plan::PlanCheck check = plan::CheckPlan(*request.solid, plan);
  EXPECT_TRUE(check.passed());
  EXPECT_TRUE(check.steps.front().is_supported);
}

}  // namespace supported_grasps_test
}  // namespace regrasp::gait
