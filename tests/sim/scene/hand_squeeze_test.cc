#include <gtest/gtest.h>

#include <cmath>

#include "planner/grasp/largest_load.h"
#include "sim/scene/scaling.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace hand_squeeze_test {

constexpr double kMass = 0.216;

/// Return the largest weight that the cube's initial grasp supports, over the grasp force.
double Carried(const CubeCase& cube, const plan::Plan& plan) {
  return grasp::ComputeLargestLoad(plan::ContactsOf(plan.initial), cube.object.wrench_frame(),
                                   plan.half_angle, {},
                                   {-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, 1)
      ->lower;
}

TEST(HandSqueeze, IsTwiceWhatTheWeightNeeds) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 20);
  const double squeeze = HandSqueeze(cube.object, plan, 1, plan.half_angle, kMass);
  EXPECT_NEAR(squeeze * Carried(cube, plan), 2 * kMass * kGravity, 1e-6);
  EXPECT_GT(squeeze, kMass * kGravity);
}

TEST(HandSqueeze, GrowsWithTheWeightUpToTheStrongestGrip) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 20);
  const auto squeeze = [&](double mass) {
    return HandSqueeze(cube.object, plan, 1, plan.half_angle, mass);
  };
  EXPECT_NEAR(squeeze(2 * kMass), 2 * squeeze(kMass), 1e-9);
  EXPECT_EQ(squeeze(1000), kStrongestGrip_N);
}

TEST(HandSqueeze, IsThatOfTheGraspThatCarriesTheWeightWorst) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 20);
  // Finger 4 is placed below and finger 0 is released, so that another grasp holds the object.
  plan.steps = {plan::Switch{{cube.At(4, 0.03, 0.02, 0.02)}, {FingerIndex(0)}}};
  const double first = HandSqueeze(cube.object, plan, 1, plan.half_angle, kMass);
  const double both = HandSqueeze(cube.object, plan, 2, plan.half_angle, kMass);
  plan.initial = plan::GraspAfter(plan.initial, plan.steps[0]);
  plan.steps.clear();
  const double second = HandSqueeze(cube.object, plan, 1, plan.half_angle, kMass);
  EXPECT_NE(first, second);
  EXPECT_EQ(both, std::max(first, second));
}

TEST(HandSqueeze, OfAPlanarObjectLiftsIt) {
  const object::ObjectFile square = ReadModel("square.wkt");
  const plan::Plan plan = MakePlan({}, 20);
  EXPECT_NEAR(HandSqueeze(*square.object, plan, 1, plan.half_angle, kMass),
              2 * kMass * kGravity / std::tan(plan.half_angle), 1e-9);
}

TEST(HandSqueeze, IsTakenByTheReplayWhereItIsAskedFor) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 20);
  plan.goal = plan::ContactsOf(plan.initial);
  ReplayOptions options;
  const ReplayResult usual = ReplayPlan(cube.object, plan, options);
  EXPECT_EQ(usual.settings.squeeze_source, SqueezeSource::kShake);
  options.hand_squeeze = true;
  const ReplayResult hand = ReplayPlan(cube.object, plan, options);
  EXPECT_EQ(hand.settings.squeeze_source, SqueezeSource::kHand);
  EXPECT_DOUBLE_EQ(hand.settings.squeeze_N,
                   HandSqueeze(cube.object, plan, 1, plan.half_angle, hand.settings.mass_kg));
  EXPECT_LT(hand.settings.squeeze_N, usual.settings.squeeze_N / 50);
  EXPECT_EQ(hand.steps.at(0).reason, plan::Reason::kNone) << hand.steps[0].detail;
  // An object that no hand can hold is dropped. With the default grasp force it was not.
  options.mass_kg = 50;
  EXPECT_NE(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
  options.hand_squeeze = false;
  EXPECT_EQ(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
}

}  // namespace hand_squeeze_test
}  // namespace regrasp::sim
