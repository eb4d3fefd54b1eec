#include "sim/judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regrasp {
namespace {

ReplaySettings UnitSettings() {
  ReplaySettings settings;
  settings.diameter_m = 2;
  settings.tolerance = 1e-3;
  return settings;
}

Eigen::Isometry3d Pose(double shift, double turn) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = shift;
  pose.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()));
  return pose;
}

TEST(JudgeTest, AddsTheShiftAndTheTurnAtTheRadius) {
  EXPECT_NEAR(MeasureMotion(Pose(0, 0), Pose(0.25, 0.5), 3), 0.25 + 1.5, 1e-12);
}

TEST(JudgeTest, TheObjectMovesBeyondTheToleranceOnly) {
  Judge judge(UnitSettings());
  judge.Start(Pose(5, 0.1));
  judge.AddPose(Pose(5.0009, 0.101));
  EXPECT_EQ(judge.reason(), Reason::kNone);
  judge.AddPose(Pose(5.0011, 0.101));
  EXPECT_EQ(judge.reason(), Reason::kObjectMoved);
  judge.AddPose(Pose(5, 0.1));
  EXPECT_EQ(judge.reason(), Reason::kObjectMoved) << "coming back does not help";
  EXPECT_NEAR(judge.displacement_m(), 0.0011, 1e-12);
}

TEST(JudgeTest, ALostContactComesBeforeASlipBeforeAMotion) {
  Judge judge(UnitSettings());
  judge.AddPose(Pose(1, 0));
  EXPECT_EQ(judge.reason(), Reason::kObjectMoved);
  judge.AddSlip(2, 0.0019);
  EXPECT_EQ(judge.reason(), Reason::kObjectMoved);
  judge.AddSlip(2, 0.0021);
  EXPECT_EQ(judge.reason(), Reason::kSlipped);
  judge.AddGap(3, 1e-6);
  EXPECT_FALSE(judge.contact_lost());
  judge.AddGap(3, 1e-4);
  EXPECT_EQ(judge.reason(), Reason::kContactLost);
  EXPECT_NE(judge.detail().find("finger 3"), std::string::npos);
  judge.Start(Pose(0, 0));
  EXPECT_EQ(judge.reason(), Reason::kNone);
  EXPECT_TRUE(judge.detail().empty());
}

TEST(JudgeTest, TheGiveOfTheServosIsNoMotion) {
  Judge judge(UnitSettings());
  judge.Start(Pose(0, 0));
  judge.SetGiving(true);
  judge.AddPose(Pose(0.1, 0));
  judge.SetGiving(false);
  judge.AddPose(Pose(0.0005, 0));
  EXPECT_EQ(judge.reason(), Reason::kNone);
  EXPECT_NEAR(judge.give_m(), 0.1, 1e-12);
  EXPECT_NEAR(judge.moved_m(), 0.0005, 1e-12);
  judge.AddPose(Pose(0.1, 0));
  EXPECT_EQ(judge.reason(), Reason::kObjectMoved) << "an object that does not come back has moved";
}

TEST(JudgeTest, MotionIsTheLargestSumOfShiftAndTurnNotTheSumOfTheLargest) {
  Judge judge(UnitSettings());
  judge.Start(Pose(0, 0));
  judge.AddPose(Pose(0.0006, 0));
  judge.AddPose(Pose(0, 0.0008));
  EXPECT_NEAR(judge.moved_m(), 0.0008, 1e-9);
  EXPECT_NEAR(judge.displacement_m() + judge.rotation_rad(), 0.0014, 1e-9);
  EXPECT_EQ(judge.reason(), Reason::kNone);
}

TEST(JudgeTest, TheSmallestConeMarginOfEveryFingerThatPressesStays) {
  ReplaySettings settings = UnitSettings();
  settings.mu = 1;
  settings.squeeze_N = 10;
  Judge judge(settings);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  judge.AddForce(0, {0, 0, 5}, up);
  judge.AddForce(1, {0, 2, 2}, up);
  judge.AddForce(1, {0, 0, 2}, up);
  judge.AddForce(2, {0, 0.004, 0.004}, up);  // hardly presses
  ASSERT_EQ(judge.margins().size(), 2u);
  EXPECT_NEAR(judge.margins().at(0), std::atan(1.0), 1e-12);
  EXPECT_NEAR(judge.margins().at(1), 0, 1e-12);
  judge.ForgetForces();
  EXPECT_TRUE(judge.margins().empty());
}

}  // namespace
}  // namespace regrasp
