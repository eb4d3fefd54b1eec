#include "sim/actuation/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace trajectory_test {

TEST(Trajectory, HasAHeaderWithUnitsAndARowPerSampleAndFinger) {
  plan::Snapshot sample;
  sample.time_s = 0.125;
  plan::FingerState state;
  state.finger = FingerIndex(3);
  state.role = plan::FingerRole::kPlaced;
  state.tip_W = {0.1, -2, 3};
  state.force_W = {0, 0, 1e-7};
  sample.fingers = {state};
  EXPECT_EQ(FormatTrajectory({sample}),
            "time_s,finger,role,tip_x_m,tip_y_m,tip_z_m,contact_x_m,contact_y_m,contact_z_m,"
            "normal_x,normal_y,normal_z,force_x_N,force_y_N,force_z_N\r\n"
            "0.125,3,placed,0.1,-2,3,0,0,0,0,0,0,0,0,1e-07\r\n");
}

TEST(Trajectory, OfAReplayRunsForwardInTimeAndItsForcesCarryTheWeightAtTheEnd) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}}};
  std::vector<plan::Snapshot> samples;
  ReplayObserver observer;
  observer.sample_interval_s = 1e-3;
  observer.on_sample = [&](const plan::Snapshot& sample) { samples.push_back(sample); };
  const ReplayResult result = ReplayPlan(cube.object, plan, {}, observer);
  ASSERT_GT(samples.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(samples, {}, &plan::Snapshot::time_s));
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const plan::FingerState& state : result.steps.back().snapshot.fingers)
    total += state.force_W;
  const double weight = 9.81 * result.settings.mass_kg;
  EXPECT_LT((total - Eigen::Vector3d(0, 0, weight)).norm(), 0.01 * weight);
  const std::string csv = FormatTrajectory(samples);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(csv, '\n')), 1 + 5 * samples.size());
}

}  // namespace trajectory_test
}  // namespace regrasp::sim
