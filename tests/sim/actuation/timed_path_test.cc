#include <gtest/gtest.h>

#include <cmath>

#include "sim/actuation/sliding_tips.h"

namespace regrasp::sim {
namespace timed_path_test {

using plan::HandState;

HandState StateAt(double joint, double x) {
  HandState state{Eigen::Isometry3d::Identity(), {{joint}}};
  state.pose.translation().x() = x;
  return state;
}

TEST(TimedPathTest, NothingIsFasterThanItMayBeAndAllOfThePathIsPassed) {
  const plan::HandPath path = {StateAt(0, 0), StateAt(1, 0.001), StateAt(1.1, 0.03)};
  const TimedPath timed(path, kHeldJoints);
  EXPECT_EQ(timed.At(0).joints[0][0], 0);
  EXPECT_EQ(timed.At(timed.duration()).joints[0][0], 1.1);
  EXPECT_EQ(timed.At(2 * timed.duration()).joints[0][0], 1.1);
  constexpr double kStep = 1e-3;
  int checked = 0;
  for (double time = 0; time < timed.duration(); time += kStep) {
    const HandState a = timed.At(time);
    const HandState b = timed.At(time + kStep);
    const double joint = b.joints[0][0] - a.joints[0][0];
    const double way = b.pose.translation().x() - a.pose.translation().x();
    EXPECT_GE(joint, 0);
    EXPECT_LE(joint, kHeldJoints * kStep * (1 + 1e-6));
    EXPECT_LE(way, kObjectSpeed * kStep * (1 + 1e-6));
    ++checked;
  }
  EXPECT_GT(checked, 100);
  // The velocity is zero at the start and at the end.
  EXPECT_LT(timed.At(kStep).joints[0][0], 0.02 * kHeldJoints * kStep);
}

TEST(TimedPathTest, APathThatGoesNowhereTakesNoTime) {
  const plan::HandPath path = {StateAt(0.3, 0), StateAt(0.3, 0)};
  const TimedPath timed(path, kFreeJoints);
  EXPECT_EQ(timed.duration(), 0);
  EXPECT_EQ(timed.At(0).joints[0][0], 0.3);
}

}  // namespace timed_path_test
}  // namespace regrasp::sim
