#include "sim/actuation/hand_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace hand_control_test {

/// Return the commanded force of the last finger of the grasp in a handover that releases it.
Eigen::Vector3d ForceInHandover(HandWorld& world, const object::Polyhedron& solid,
                                const plan::Plan& plan, double share) {
  world.Place(plan.hand->initial);
  world.PinObject(true);
  HandControl control(world, solid, plan.scale, {std::atan(0.8), 1});
  Hold before = {{}, 5};
  for (const plan::FingerContact& held : plan.initial) {
    control.Attach(held.finger);
    before.fingers.push_back(held.finger);
  }
  Hold after = before;
  after.fingers.pop_back();
  control.SetHolding({before, after, share, 1});
  control.Step();
  return control.force(before.fingers.back());
}

TEST_F(HeldInHand, AHandoverGoesFromTheForcesBeforeToThoseAfter) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  const auto force = [&](double share) { return ForceInHandover(world, solid(), plan_, share); };
  const Eigen::Vector3d first = force(0);
  EXPECT_GT(first.norm(), 2 * HandControl::kTouchForce);
  EXPECT_LT((force(0.25) - 0.75 * first).norm(), 1e-9 * first.norm());
  EXPECT_NEAR(force(1).norm(), HandControl::kTouchForce, 1e-9);
}

TEST_F(HeldInHand, AShakePushesAndTwists) {
  const auto shaken = [&](double disturbance_ratio) {
    HandReplayOptions options;
    options.mass_kg = kMass;
    options.disturbance_ratio = disturbance_ratio;
    return ReplayHand(hand_, solid(), plan_, options, {}, 1).steps.back();
  };
  EXPECT_EQ(shaken(0).reason, plan::Reason::kNone);
  EXPECT_EQ(shaken(0.03).reason, plan::Reason::kNone);
  // Servos yield to a torque first. A larger disturbance also fails by its force, which is tested
  // before the torque.
  const StepReplay twisted = shaken(0.1);
  EXPECT_EQ(twisted.reason, plan::Reason::kObjectMoved);
  ASSERT_TRUE(twisted.fault.disturbance);
  EXPECT_TRUE(twisted.fault.disturbance->force_N.isZero());
  EXPECT_FALSE(twisted.fault.disturbance->torque_Nm.isZero());
  const StepReplay pushed = shaken(0.3);
  EXPECT_EQ(pushed.reason, plan::Reason::kObjectMoved);
  ASSERT_TRUE(pushed.fault.disturbance);
  EXPECT_FALSE(pushed.fault.disturbance->force_N.isZero());
}

}  // namespace hand_control_test
}  // namespace regrasp::sim
