#include "sim/actuation/torque_grasp_force.h"

#include <gtest/gtest.h>

#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace torque_grasp_force_test {

TEST_F(HeldInHand, TheSqueezeIsWhatActuatorsBearAndTwiceThatOfActuatorsOfTwiceTheForce) {
  constexpr double kMost = 100;
  const auto grasp_force = [&](double force_factor) {
    // Without gravity the torques depend on the grasp force alone.
    HandWorld world(hand_, solid(), kScale,
                    {.mu = kMu, .mass_kg = kMass, .gravity_m_s2 = 0, .force_factor = force_factor});
    return StaticGraspForce(world, solid(), kScale, plan_.hand->initial, plan_.initial,
                            std::atan(kMu), 0, kMost);
  };
  const double usual = grasp_force(1);
  EXPECT_GT(usual, 0);
  EXPECT_LT(2 * usual, kMost);
  // Ten bisections leave an error of 1/1000 of the maximum, once for one value and twice for the
  // other.
  EXPECT_NEAR(grasp_force(2), 2 * usual, 3e-3 * kMost);
  EXPECT_EQ(grasp_force(1e6), kMost);
}

TEST_F(HeldInHand, TheLargestGraspForceIsAMultipleOfTheWeightButEnoughForALightObject) {
  EXPECT_EQ(LargestGraspForce(10), 10 * kMostWeights);
  EXPECT_EQ(LargestGraspForce(0.1), kEnough);
}

TEST_F(HeldInHand, AGraspForceThatTorquesAllowIsReducedUntilTheGraspIsStable) {
  constexpr double kMost = 1000;
  HandWorld world(hand_, solid(), kScale,
                  {.mu = kMu, .mass_kg = kMass, .gravity_m_s2 = 0, .force_factor = 1e6});
  const double stable = StaticGraspForce(world, solid(), kScale, plan_.hand->initial, plan_.initial,
                                         std::atan(kMu), 0, kMost);
  EXPECT_LT(stable, kMost);
  EXPECT_GT(stable, kEnough);
}

}  // namespace torque_grasp_force_test
}  // namespace regrasp::sim
