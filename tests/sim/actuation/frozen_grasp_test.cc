#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planner/plan/reason.h"
#include "sim/actuation/hand_replay.h"
#include "tests/sim/actuation/edited_hand.h"

namespace regrasp::sim {
namespace frozen_grasp_test {

using plan::Reason;

class FrozenGraspTest : public EditedHandTest {
 protected:
  /// Return the initial grasp of a plan for ring5, executed with other servos and no disturbance.
  /// @param stiffness    stiffness of all servos, N m/rad.
  /// @param grasp_force in weights of the object.
  [[nodiscard]] StepReplay InitialGrasp(const std::string& stiffness, double grasp_force,
                                        double freeze_s = 1) const {
    const kinematics::HandFile hand = HandWith({{"kp=\"2.0\"", "kp=\"" + stiffness + "\""}});
    HandReplayOptions options;
    options.mass_kg = kMass;
    options.disturbance_ratio = 0;
    options.freeze_s = freeze_s;
    options.grasp_force_N = grasp_force * kMass * 9.81;
    return ReplayHand(hand, solid(), PlanFor(hand), options, {}, 1).steps.back();
  }
};

TEST_F(FrozenGraspTest, AStaticGraspHoldsUnderConstantControls) {
  const StepReplay step = InitialGrasp("2.0", 12);
  EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
  ASSERT_TRUE(step.hand);
  EXPECT_LT(step.hand->frozen_off_m, 2e-4);
}

/// Opposed fingers on soft servos buckle. Only the controller holds this grasp.
TEST_F(FrozenGraspTest, ALargeGraspForceOnSoftServosIsNotStatic) {
  const StepReplay step = InitialGrasp("0.2", 20);
  EXPECT_EQ(step.reason, Reason::kNotStatic) << step.detail;
  EXPECT_GT(step.hand->frozen_off_m, 1e-3);
  EXPECT_THAT(step.detail, testing::HasSubstr("under constant controls"));
  EXPECT_EQ(InitialGrasp("0.2", 20, 0).reason, Reason::kNone);
  EXPECT_EQ(InitialGrasp("2.0", 20).reason, Reason::kNone);
}

/// The further replay is the same with and without the test, to the bit.
TEST_F(FrozenGraspTest, TheReplayContinuesFromTheStaticGrasp) {
  const kinematics::HandFile hand = HandWith({});
  const plan::Plan plan = PlanFor(hand);
  HandReplayOptions options;
  options.mass_kg = kMass;
  const ReplayResult with = ReplayHand(hand, solid(), plan, options);
  options.freeze_s = 0;
  const ReplayResult without = ReplayHand(hand, solid(), plan, options);
  ASSERT_EQ(with.steps.size(), plan.steps.size() + 1);
  ASSERT_EQ(with.steps.size(), without.steps.size());
  for (std::size_t i = 0; i < with.steps.size(); ++i) {
    EXPECT_EQ(with.steps[i].hand->off_m, without.steps[i].hand->off_m);
    EXPECT_EQ(with.steps[i].hand->slip_m, without.steps[i].hand->slip_m);
    EXPECT_GT(with.steps[i].hand->frozen_off_m, 0);
    EXPECT_EQ(without.steps[i].hand->frozen_off_m, 0);
  }
}

}  // namespace frozen_grasp_test
}  // namespace regrasp::sim
