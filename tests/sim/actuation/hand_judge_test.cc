#include "sim/actuation/hand_judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace hand_judge_test {

using plan::Reason;

constexpr double kAnything = 1e9;

/// Return tolerances that only allow failures by colliding links.
HandTolerance AnyTolerance() {
  return {.length_m = kAnything,
          .angle_rad = kAnything,
          .at_rest = 1,
          .slip_m = kAnything,
          .lost_s = kAnything,
          .limit_s = kAnything,
          .joint_rad = kAnything,
          .depth_m = kAnything};
}

/// Share of the measured value. Replays are identical until one of them ends, so any share is
/// decisive.
constexpr double kAHundredth = 0.01;

class HandJudgeTest : public HeldInHand {
 protected:
  /// Return the last replayed step, without a disturbance test.
  [[nodiscard]] StepReplay Replay(const HandTolerance& tolerance, double force_factor = 1) const {
    HandReplayOptions options;
    options.half_angle = std::atan(kMu);
    options.mass_kg = kMass;
    options.shake = 0;
    options.force_factor = force_factor;
    options.tolerance = tolerance;
    return ReplayHand(hand_, solid(), plan_, options).steps.back();
  }
  /// Expect that a replay passes if the tolerance is 1 % above the measured value, and fails if it
  /// is 1 % below.
  void ExpectDecides(double HandTolerance::*allowed, double measured, Reason reason) const {
    ASSERT_GT(measured, 0);
    HandTolerance tolerance = AnyTolerance();
    if (allowed == &HandTolerance::at_rest) tolerance.angle_rad = 1;
    tolerance.*allowed = (1 + kAHundredth) * measured;
    EXPECT_EQ(Replay(tolerance).reason, Reason::kNone);
    tolerance.*allowed = (1 - kAHundredth) * measured;
    EXPECT_EQ(Replay(tolerance).reason, reason);
  }
};

TEST_F(HandJudgeTest, EveryToleranceDecidesByWhatIsMeasured) {
  const StepReplay step = Replay(AnyTolerance());
  ASSERT_TRUE(step.hand);
  ExpectDecides(&HandTolerance::length_m, step.hand->off_m, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::angle_rad, step.hand->off_rad, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::at_rest, step.hand->rest_off_rad, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::slip_m, step.hand->slip_m, Reason::kSlipped);
}

TEST_F(HandJudgeTest, FingersWithoutForceLoseTheirContactsAndActuatorsStandAtTheirLimits) {
  constexpr double kWeak = 0.02;  // share of the actuators' force limits
  EXPECT_EQ(Replay(AnyTolerance()).reason, Reason::kNone);
  HandTolerance tolerance = AnyTolerance();
  tolerance.lost_s = HandTolerance().lost_s;
  EXPECT_EQ(Replay(tolerance).reason, Reason::kNone);
  EXPECT_EQ(Replay(tolerance, kWeak).reason, Reason::kContactLost);
  tolerance = AnyTolerance();
  tolerance.limit_s = HandTolerance().limit_s;
  EXPECT_EQ(Replay(tolerance).reason, Reason::kNone);
  EXPECT_EQ(Replay(tolerance, kWeak).reason, Reason::kTorqueLimit);
}

TEST_F(HandJudgeTest, FingersMayBeFromTheirContactsAsFarAsTheyMaySlip) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  HandTolerance tolerance = AnyTolerance();
  tolerance.slip_m = HandTolerance().slip_m;
  for (const double share : {0.9, 1.1}) {
    plan::FingerGrasp elsewhere = plan_.initial;
    grasp::Contact& contact = elsewhere.front().contact;
    contact.p += share * tolerance.slip_m / kScale * contact.n.unitOrthogonal();
    HandJudge judge(world, solid(), kScale, tolerance);
    judge.Start();
    judge.WatchContacts(plan_.initial, kScale);
    ASSERT_FALSE(judge.breach()) << judge.breach()->detail;
    judge.WatchContacts(elsewhere, kScale);
    EXPECT_EQ(judge.breach() ? judge.breach()->reason : Reason::kNone,
              share > 1 ? Reason::kContactLost : Reason::kNone);
  }
}

/// Return the least distance between two fingertips.
double LeastTipDistance(const HandWorld& world) {
  double least = std::numeric_limits<double>::infinity();
  for (FingerIndex a{0}; a < std::ssize(world.hand().fingers); ++a) {
    for (FingerIndex b{0}; b < a; ++b) {
      least = std::min(least, (world.tip(a) - world.tip(b)).norm());
    }
  }
  return least;
}

TEST_F(HandJudgeTest, TipsThatAreInEachOtherTouch) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  plan::HandState state = plan_.hand->initial;
  state.pose.translation().z() += 1;  // out of reach
  std::mt19937 random(1);
  int touching = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // With equal joint angles in all fingers of the ring, the fingertips meet on its axis.
    const kinematics::Finger& chain = hand_.hand.fingers[FingerIndex(0)];
    for (std::size_t k = 0; k < state.joints[FingerIndex(0)].size(); ++k) {
      std::uniform_real_distribution<double> angle(chain.lower[k], chain.upper[k]);
      const double drawn = angle(random);
      for (auto& joints : state.joints) joints[k] = drawn;
    }
    world.Place(state);
    if (LeastTipDistance(world) > 1.8 * chain.tip.radius) continue;
    ++touching;
    HandJudge judge(world, solid(), kScale, AnyTolerance());
    judge.Start();
    judge.Watch(state.pose);
    ASSERT_TRUE(judge.breach());
    EXPECT_EQ(judge.breach()->reason, Reason::kHandCollides);
    EXPECT_THAT(judge.breach()->detail, testing::Not(testing::HasSubstr("object")));
  }
  EXPECT_GT(touching, 3);
  world.Place(plan_.hand->initial);
  HandJudge judge(world, solid(), kScale, AnyTolerance());
  judge.Start();
  judge.Watch(plan_.hand->initial.pose);
  EXPECT_FALSE(judge.breach()) << judge.breach()->detail;
}

}  // namespace hand_judge_test
}  // namespace regrasp::sim
