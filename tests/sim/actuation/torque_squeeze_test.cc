#include "sim/actuation/torque_squeeze.h"

#include <gtest/gtest.h>

#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace torque_squeeze_test {

TEST_F(HeldInHand, TheSqueezeIsWhatActuatorsBearAndTwiceThatOfActuatorsOfTwiceTheForce) {
  constexpr double kMost = 100;
  const auto squeeze = [&](double force_factor) {
    // Without gravity the torques depend on the grasp force alone.
    HandWorld world(hand_, solid(), kScale,
                    {.mu = kMu, .mass_kg = kMass, .gravity_m_s2 = 0, .force_factor = force_factor});
    return RestSqueeze(world, solid(), kScale, plan_.hand->initial, plan_.initial, std::atan(kMu),
                       0, kMost);
  };
  const double usual = squeeze(1);
  EXPECT_GT(usual, 0);
  EXPECT_LT(2 * usual, kMost);
  // Ten bisections leave an error of 1/1000 of the maximum, once for one value and twice for the
  // other.
  EXPECT_NEAR(squeeze(2), 2 * usual, 3e-3 * kMost);
  EXPECT_EQ(squeeze(1e6), kMost);
}

TEST_F(HeldInHand, TheLargestGraspForceIsAMultipleOfTheWeightButEnoughForALightObject) {
  EXPECT_EQ(MostSqueeze(10), 10 * kMostWeights);
  EXPECT_EQ(MostSqueeze(0.1), kEnough);
}

TEST_F(HeldInHand, AGraspForceThatTorquesAllowIsReducedUntilTheGraspIsStable) {
  constexpr double kMost = 1000;
  HandWorld world(hand_, solid(), kScale,
                  {.mu = kMu, .mass_kg = kMass, .gravity_m_s2 = 0, .force_factor = 1e6});
  const double stable = RestSqueeze(world, solid(), kScale, plan_.hand->initial, plan_.initial,
                                    std::atan(kMu), 0, kMost);
  EXPECT_LT(stable, kMost);
  EXPECT_GT(stable, kEnough);
}

}  // namespace torque_squeeze_test
}  // namespace regrasp::sim
