#include "sim/control/slide.h"

#include <gtest/gtest.h>

#include "sim/scene/scaling.h"
#include "tests/sim/held_cube.h"

namespace regrasp::sim {
namespace motions_test {

using Eigen::Vector3d;

Vector3d SumOfForces(const ReplayWorld& world) {
  Vector3d sum = Vector3d::Zero();
  for (const FingerIndex f : world.HoldingFingers()) sum += world.engine().tip_force(f).force;
  return sum;
}

TEST(TakeHoldTest, AtRestTheFingersCarryTheWeightAndNothingElse) {
  for (const EngineChoice engine : {EngineChoice::kMujoco, EngineChoice::kOde}) {
    for (const bool gravity : {true, false}) {
      ReplayOptions options;
      options.engine = engine;
      options.gravity = gravity;
      const HeldCube held(options);
      const ReplaySettings& s = held.world.settings();
      const double cube_weight = s.mass_kg * kGravity;
      const Vector3d carried = SumOfForces(held.world);
      const Vector3d expected(0, 0, gravity ? cube_weight : 0);
      // An object that counts as static may still accelerate slightly, which changes the force.
      constexpr double kStillMoving = 0.01;
      EXPECT_LT((carried - expected).norm(), kStillMoving * cube_weight) << carried.transpose();
    }
  }
}

TEST(TakeHoldTest, PlannedForcesBalanceTheWeight) {
  const HeldCube held;
  const ReplaySettings& s = held.world.settings();
  Vector3d sum = Vector3d::Zero();
  for (const FingerIndex f : held.world.HoldingFingers()) sum += held.world.fingers()[f].force_S;
  const Vector3d up(0, 0, s.mass_kg * s.gravity_m_s2);
  // share of the weight; planned forces are the solution of a linear program
  constexpr double kPlanned = 1e-3;
  EXPECT_LT((sum - up).norm(), kPlanned * up.norm()) << sum.transpose();
}

TEST(RetractFingersTest, AFingerThatLeftStopsNothing) {
  HeldCube held;
  ReplayWorld& world = held.world;
  const FingerIndex finger = held.plan.initial.back().finger;
  const grasp::Contact contact = world.fingers()[finger].contact;
  const auto press = [&] {
    WorldFinger& pressing = world.fingers()[finger];
    pressing.anchor_S = world.TipAt_S(contact, -1e-6 * world.settings().diameter_m);
    pressing.force_S = 0.1 * world.settings().grasp_force_N * (world.X_SB().linear() * contact.n);
    world.engine().PlaceTip(finger, pressing.anchor_S);
    world.Step();
    return world.engine().tip_force(finger).force.norm();
  };
  EXPECT_GT(press(), 0);
  RetractFingers(world, {finger});
  EXPECT_EQ(press(), 0);
}

}  // namespace motions_test
}  // namespace regrasp::sim
