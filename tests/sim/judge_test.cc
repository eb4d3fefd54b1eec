#include "sim/judge.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace regrasp
