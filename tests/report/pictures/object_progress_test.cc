#include "report/pictures/object_progress.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"

namespace regrasp::report {
namespace object_progress_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d Turned(double degrees, const Vector3d& axis = Vector3d::UnitZ(), double shift_m = 0) {
  Isometry3d pose(Eigen::AngleAxisd(Radians(degrees), axis.normalized()));
  pose.translation().x() = shift_m;
  return pose;
}

/// Return poses from 0 to `degrees` in steps of 10°.
std::vector<Isometry3d> TurnTo(double degrees) {
  std::vector<Isometry3d> poses;
  for (double angle = 0; angle <= degrees + 1e-9; angle += 10) poses.push_back(Turned(angle));
  return poses;
}

TEST(ObjectProgressTest, StatesTheAngleUpToNowAndThatOfThePlan) {
  ObjectProgress progress(TurnTo(90));
  EXPECT_EQ(progress.Text(), "0° of 90°");
  progress.Follow(Turned(36.7));
  EXPECT_EQ(progress.Text(), "36.7° of 90°");
  progress.Follow(Turned(-5));
  EXPECT_EQ(progress.Text(), "-5° of 90°");
}

TEST(ObjectProgressTest, AnglesCanExceedHalfATurn) {
  for (const int goal : {270, 360, 450}) {
    const std::vector<Isometry3d> poses = TurnTo(goal);
    ObjectProgress progress(poses);
    for (const Isometry3d& pose : poses) progress.Follow(pose);
    const std::string text = std::to_string(goal) + "°";
    EXPECT_EQ(progress.Text(), text + " of " + text);
  }
}

TEST(ObjectProgressTest, OtherRotationsDoNotCount) {
  ObjectProgress progress(TurnTo(90));
  progress.Follow(Turned(20, Vector3d::UnitX()));
  EXPECT_EQ(progress.Text(), "0° of 90°");
  // A detour about another axis does not change the angle of the goal.
  const std::vector<Isometry3d> detour = {Turned(0), Turned(30, {0, 1, 1}), Turned(60, {0, -1, 2}),
                                          Turned(90)};
  EXPECT_EQ(ObjectProgress(detour).Text(), "0° of 90°");
}

TEST(ObjectProgressTest, WithoutARotationItIsADistance) {
  ObjectProgress progress({Turned(0), Turned(0, Vector3d::UnitZ(), 0.03)});
  EXPECT_FALSE(progress.goal_angle());
  progress.Follow(Turned(2, Vector3d::UnitZ(), 0.012));
  EXPECT_EQ(progress.Text(), "1.2 cm of 3 cm");
  EXPECT_EQ(ObjectProgress({Turned(0), Turned(0)}).Text(), "");
}

}  // namespace object_progress_test
}  // namespace regrasp::report
