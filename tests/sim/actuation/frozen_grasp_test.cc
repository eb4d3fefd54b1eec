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
  /// Return the initial grasp of a plan for ring5, without disturbance test.
  /// Only `frozen` limits the object, so that a grasp that yields is still tested.
  /// @param stiffness    true over nominal stiffness of the servos.
  /// @param grasp_force  in weights of the object.
  [[nodiscard]] StepReplay InitialGrasp(double stiffness, double grasp_force,
                                        const HandTolerance& frozen = {},
                                        double freeze_s = 1) const {
    const kinematics::HandFile hand = HandWith({});
    HandReplayOptions options;
    options.mass_kg = kMass;
    options.disturbance_ratio = 0;
    options.freeze_s = freeze_s;
    options.grasp_force_N = grasp_force * kMass * 9.81;
    options.physics.gain_factor = stiffness;
    options.tolerance = {.length_m = 1,
                         .angle_rad = 1,
                         .at_rest = 1,
                         .slip_m = 1,
                         .limit_s = 10,
                         .depth_m = 1,
                         .frozen_m = frozen.frozen_m,
                         .frozen_rad = frozen.frozen_rad};
    return ReplayHand(hand, solid(), PlanFor(hand), options, {}, 1).steps.back();
  }
};

TEST_F(FrozenGraspTest, AStaticGraspHoldsUnderConstantControls) {
  const StepReplay step = InitialGrasp(1, 12);
  EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
  ASSERT_TRUE(step.hand);
  EXPECT_LT(step.hand->frozen_off_m, 2e-4);
}

/// Opposed fingers on soft servos buckle. Only the controller holds this grasp.
TEST_F(FrozenGraspTest, ALargeGraspForceOnSoftServosIsNotStatic) {
  const StepReplay step = InitialGrasp(0.05, 30);
  EXPECT_EQ(step.reason, Reason::kNotStatic) << step.detail;
  EXPECT_GT(step.hand->frozen_off_m, 1e-3);
  EXPECT_THAT(step.detail, testing::HasSubstr("under constant controls"));
  EXPECT_EQ(InitialGrasp(0.05, 30, {}, 0).reason, Reason::kNone);
  EXPECT_EQ(InitialGrasp(1, 30).reason, Reason::kNone);
}

TEST_F(FrozenGraspTest, BothLimitsDecideByTheMeasuredMotion) {
  const HandMeasures measures = *InitialGrasp(1, 12).hand;
  ASSERT_GT(measures.frozen_off_m, 0);
  ASSERT_GT(measures.frozen_off_rad, 0);
  for (const double share : {0.99, 1.01}) {
    const Reason expected = share < 1 ? Reason::kNotStatic : Reason::kNone;
    EXPECT_EQ(InitialGrasp(1, 12, {.frozen_m = share * measures.frozen_off_m}).reason, expected);
    EXPECT_EQ(InitialGrasp(1, 12, {.frozen_rad = share * measures.frozen_off_rad}).reason,
              expected);
  }
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
