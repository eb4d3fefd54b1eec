#include "sim/actuation/hand_sensors.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace hand_sensors_test {

using Eigen::Vector3d;

/// A measured deviation and the time at which it arrived.
struct Arrived {
  double time;
  PoseDeviation deviation;
};

class HandSensorsTest : public HeldInHand {
 protected:
  /// Run the sensors for a time with an object that does not move.
  /// @param off  planned pose minus the object's pose, metres.
  std::vector<Arrived> Run(const HandSensing& sensing, double seconds,
                           const Vector3d& off = Vector3d::Zero()) {
    HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
    world.Place(plan_.hand->initial);
    world.PinObject(true);
    HandSensors sensors(world, sensing);
    const Eigen::Isometry3d planned = Eigen::Translation3d(off) * world.object_pose();
    std::vector<Arrived> arrived;
    for (int i = 0; i < seconds / world.timestep(); ++i) {
      sensors.Update(planned);
      while (const auto deviation = sensors.TakeDeviation()) {
        arrived.push_back({world.time(), *deviation});
      }
      world.Step();
    }
    return arrived;
  }

  static constexpr HandSensing kExact{
      .pose_delay_s = 0.05, .pose_rate_Hz = 20, .pose_noise_m = 0, .pose_noise_rad = 0};
};

TEST_F(HandSensorsTest, MeasurementsArriveAtTheirRateAfterTheDelay) {
  const Vector3d off(1e-3, 0, -2e-3);
  const std::vector<Arrived> arrived = Run(kExact, 0.5, off);
  ASSERT_EQ(arrived.size(), 9U);
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    EXPECT_NEAR(arrived[i].time, 0.05 + 0.05 * static_cast<double>(i), 2e-3);
    EXPECT_LT((arrived[i].deviation.shift_m - off).norm(), 1e-9);
    EXPECT_LT(arrived[i].deviation.turn_rad.norm(), 1e-9);
  }
}

TEST_F(HandSensorsTest, WithoutFeedbackNothingArrives) {
  HandSensing blind = kExact;
  blind.feedback = PoseFeedback::kNone;
  EXPECT_TRUE(Run(blind, 0.5).empty());
}

/// The object is far away, so the force is exactly 0.
TEST_F(HandSensorsTest, WithoutForceNoThresholdIsReached) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  plan::HandState away = plan_.hand->initial;
  away.pose.translation().z() += 0.2;
  world.Place(away);
  for (const double threshold : {0.0, 0.3}) {
    HandSensing sensing = kExact;
    sensing.touch_N = threshold;
    EXPECT_FALSE(HandSensors(world, sensing).Touches(FingerIndex{0})) << threshold;
  }
}

TEST_F(HandSensorsTest, NoiseDiffersByMeasurementAndABiasDoesNot) {
  HandSensing noisy = kExact;
  noisy.pose_noise_m = 3e-4;
  const std::vector<Arrived> noise = Run(noisy, 0.5);
  EXPECT_GT((noise[0].deviation.shift_m - noise[1].deviation.shift_m).norm(), 1e-6);
  const std::vector<Arrived> again = Run(noisy, 0.5);
  EXPECT_EQ(noise[3].deviation.shift_m, again[3].deviation.shift_m);
  noisy.seed = 1;
  EXPECT_NE(noise[3].deviation.shift_m, Run(noisy, 0.5)[3].deviation.shift_m);
  HandSensing biased = kExact;
  biased.pose_bias_m = 3e-4;
  const std::vector<Arrived> bias = Run(biased, 0.5);
  EXPECT_GT(bias[0].deviation.shift_m.norm(), 1e-6);
  EXPECT_LT((bias[0].deviation.shift_m - bias[5].deviation.shift_m).norm(), 1e-9);
}

TEST_F(HandSensorsTest, ACopyOfTheStateContinuesIdentically) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  HandSensing noisy = kExact;
  noisy.pose_noise_m = 3e-4;
  HandSensors first(world, noisy);
  HandSensors second(world, noisy);
  const Eigen::Isometry3d pose = world.object_pose();
  first.Update(pose);
  second.CopyState(first);
  for (int i = 0; i < 60; ++i) world.Step();
  const auto a = first.TakeDeviation();
  const auto b = second.TakeDeviation();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->shift_m, b->shift_m);
  EXPECT_FALSE(HandSensors(world, noisy).TakeDeviation());
}

}  // namespace hand_sensors_test
}  // namespace regrasp::sim
