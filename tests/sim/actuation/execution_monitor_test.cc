#include "sim/actuation/execution_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace execution_monitor_test {

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
          .depth_m = kAnything,
          .frozen_m = kAnything,
          .frozen_rad = kAnything};
}

/// Share of a measured value. Replays are equal until one of them ends, so that any share decides.
constexpr double kAHundredth = 0.01;

class ExecutionMonitorTest : public HeldInHand {
 protected:
  /// Return the last step of a replay without disturbance tests, with the largest measurements of
  /// all steps.
  [[nodiscard]] StepReplay Replay(const HandTolerance& tolerance, double force_factor = 1) const {
    HandReplayOptions options;
    options.mass_kg = kMass;
    options.disturbance_ratio = 0;
    options.force_factor = force_factor;
    options.tolerance = tolerance;
    const ReplayResult result = ReplayHand(hand_, solid(), plan_, options);
    StepReplay last = result.steps.back();
    for (const StepReplay& step : result.steps) {
      for (double HandMeasures::*measure :
           {&HandMeasures::off_m, &HandMeasures::off_rad, &HandMeasures::rest_off_m,
            &HandMeasures::rest_off_rad, &HandMeasures::slip_m}) {
        (*last.hand).*measure = std::max((*last.hand).*measure, (*step.hand).*measure);
      }
    }
    return last;
  }
  /// Expect a pass if the limit is a hundredth above the measured value, and a failure below it.
  void ExpectDecides(double HandTolerance::*allowed, double measured, Reason reason) const {
    ASSERT_GT(measured, 0);
    HandTolerance tolerance = AnyTolerance();
    if (allowed == &HandTolerance::at_rest) {
      tolerance.angle_rad = 1;
      tolerance.length_m = 1e6;
    }
    tolerance.*allowed = (1 + kAHundredth) * measured;
    const StepReplay above = Replay(tolerance);
    EXPECT_EQ(above.reason, Reason::kNone) << above.detail;
    tolerance.*allowed = (1 - kAHundredth) * measured;
    EXPECT_EQ(Replay(tolerance).reason, reason);
  }
};

TEST_F(ExecutionMonitorTest, EveryToleranceDecidesByWhatIsMeasured) {
  const StepReplay step = Replay(AnyTolerance());
  ASSERT_TRUE(step.hand);
  ExpectDecides(&HandTolerance::length_m, step.hand->off_m, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::angle_rad, step.hand->off_rad, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::at_rest, step.hand->rest_off_rad, Reason::kObjectMoved);
  ExpectDecides(&HandTolerance::slip_m, step.hand->slip_m, Reason::kSlipped);
}

TEST_F(ExecutionMonitorTest, FingersWithoutForceLoseTheirContactsAndActuatorsStandAtTheirLimits) {
  constexpr double kWeak = 0.02;  // of the actuators' force
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

TEST_F(ExecutionMonitorTest, FingersMayBeFromTheirContactsAsFarAsTheyMaySlip) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  HandTolerance tolerance = AnyTolerance();
  tolerance.slip_m = HandTolerance().slip_m;
  for (const double share : {0.9, 1.1}) {
    plan::FingerGrasp elsewhere = plan_.initial;
    grasp::Contact& contact = elsewhere.front().contact;
    contact.p += share * tolerance.slip_m / kScale * contact.n.unitOrthogonal();
    ExecutionMonitor monitor(world, solid(), kScale, tolerance);
    monitor.Start();
    monitor.WatchContacts(plan_.initial, kScale);
    ASSERT_FALSE(monitor.violation()) << monitor.violation()->detail;
    monitor.WatchContacts(elsewhere, kScale);
    EXPECT_EQ(monitor.violation() ? monitor.violation()->reason : Reason::kNone,
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

TEST_F(ExecutionMonitorTest, TipsThatAreInEachOtherTouch) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  plan::HandState state = plan_.hand->initial;
  state.pose.translation().z() += 1;  // far from the object
  std::mt19937 random(1);
  int touching = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // All fingers of the ring have the same joint angles, and meet about its axis.
    const kinematics::Finger& chain = hand_.hand.fingers[FingerIndex(0)];
    for (std::size_t k = 0; k < state.joints[FingerIndex(0)].size(); ++k) {
      std::uniform_real_distribution<double> angle(chain.lower[k], chain.upper[k]);
      const double drawn = angle(random);
      for (auto& joints : state.joints) joints[k] = drawn;
    }
    world.Place(state);
    if (LeastTipDistance(world) > 1.8 * chain.tip.radius) continue;
    ++touching;
    ExecutionMonitor monitor(world, solid(), kScale, AnyTolerance());
    monitor.Start();
    monitor.Watch(state.pose);
    ASSERT_TRUE(monitor.violation());
    EXPECT_EQ(monitor.violation()->reason, Reason::kHandCollides);
    EXPECT_THAT(monitor.violation()->detail, testing::Not(testing::HasSubstr("object")));
  }
  EXPECT_GT(touching, 3);
  world.Place(plan_.hand->initial);
  ExecutionMonitor monitor(world, solid(), kScale, AnyTolerance());
  monitor.Start();
  monitor.Watch(plan_.hand->initial.pose);
  EXPECT_FALSE(monitor.violation()) << monitor.violation()->detail;
}

}  // namespace execution_monitor_test
}  // namespace regrasp::sim
