#include <gtest/gtest.h>

#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "sim/scene/scaling.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace hand_grasp_force_test {

constexpr double kMass = 0.216;

/// Return the largest weight that the cube's initial grasp supports, over the grasp force.
double Carried(const CubeCase& cube, const plan::Plan& plan) {
  return grasp::ComputeLargestLoad(plan::ContactsOf(plan.initial), cube.object.wrench_frame(),
                                   plan.friction_angle, {},
                                   {-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, 1)
      ->lower;
}

TEST(HandGraspForce, IsTwiceWhatTheWeightNeeds) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 20);
  const double grasp_force = HandGraspForce(cube.object, plan, 1, plan.friction_angle, kMass);
  EXPECT_NEAR(grasp_force * Carried(cube, plan), 2 * kMass * kGravity, 1e-6);
  EXPECT_GT(grasp_force, kMass * kGravity);
}

TEST(HandGraspForce, GrowsWithTheWeightUpToTheStrongestGrip) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 20);
  const auto grasp_force = [&](double mass) {
    return HandGraspForce(cube.object, plan, 1, plan.friction_angle, mass);
  };
  EXPECT_NEAR(grasp_force(2 * kMass), 2 * grasp_force(kMass), 1e-9);
  EXPECT_EQ(grasp_force(1000), kStrongestGrip_N);
}

TEST(HandGraspForce, IsThatOfTheGraspThatCarriesTheWeightWorst) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 20);
  // Finger 4 is placed below and finger 0 is released, so that another grasp holds the object.
  plan.steps = {plan::Switch{{cube.At(4, 0.03, 0.02, 0.02)}, {FingerIndex(0)}}};
  const double first = HandGraspForce(cube.object, plan, 1, plan.friction_angle, kMass);
  const double both = HandGraspForce(cube.object, plan, 2, plan.friction_angle, kMass);
  plan.initial = plan::GraspAfter(plan.initial, plan.steps[0]);
  plan.steps.clear();
  const double second = HandGraspForce(cube.object, plan, 1, plan.friction_angle, kMass);
  EXPECT_NE(first, second);
  EXPECT_EQ(both, std::max(first, second));
}

TEST(HandGraspForce, OfAPlanarObjectLiftsIt) {
  const object::ObjectFile square = ReadModel("square.wkt");
  const plan::Plan plan = MakePlan({}, 20);
  EXPECT_NEAR(HandGraspForce(*square.object, plan, 1, plan.friction_angle, kMass),
              2 * kMass * kGravity / std::tan(plan.friction_angle), 1e-9);
}

TEST(HandGraspForce, IsTakenByTheReplayWhereItIsAskedFor) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 20);
  plan.goal = plan::ContactsOf(plan.initial);
  ReplayOptions options;
  const ReplayResult usual = ReplayPlan(cube.object, plan, options);
  EXPECT_EQ(usual.settings.grasp_force_source, GraspForceSource::kDisturbance);
  options.hand_grasp_force = true;
  const ReplayResult hand = ReplayPlan(cube.object, plan, options);
  EXPECT_EQ(hand.settings.grasp_force_source, GraspForceSource::kHand);
  EXPECT_DOUBLE_EQ(
      hand.settings.grasp_force_N,
      HandGraspForce(cube.object, plan, 1, plan.friction_angle, hand.settings.mass_kg));
  EXPECT_LT(hand.settings.grasp_force_N, usual.settings.grasp_force_N / 50);
  EXPECT_EQ(hand.steps.at(0).reason, plan::Reason::kNone) << hand.steps[0].detail;
  // An object that no hand can hold is dropped. With the default grasp force it was not.
  options.mass_kg = 50;
  EXPECT_NE(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
  options.hand_grasp_force = false;
  EXPECT_EQ(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
}

}  // namespace hand_grasp_force_test
}  // namespace regrasp::sim
