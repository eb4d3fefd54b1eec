#include "sim/world/motion_monitor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"

namespace regrasp::sim {
namespace motion_monitor_test {

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

TEST(MotionMonitorTest, AddsTheShiftAndTheTurnAtTheRadius) {
  EXPECT_NEAR(MeasureMotion(Pose(0, 0), Pose(0.25, 0.5), 3), 0.25 + 1.5, 1e-12);
}

TEST(MotionMonitorTest, TheObjectMovesBeyondTheToleranceOnly) {
  MotionMonitor monitor(UnitSettings());
  monitor.Start(Pose(5, 0.1));
  monitor.AddPose(Pose(5.0009, 0.101));
  EXPECT_EQ(monitor.reason(), plan::Reason::kNone);
  monitor.AddPose(Pose(5.0011, 0.101));
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved);
  monitor.AddPose(Pose(5, 0.1));
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved) << "coming back does not help";
  EXPECT_NEAR(monitor.displacement_m(), 0.0011, 1e-12);
}

TEST(MotionMonitorTest, TolerancesAreThoseOfTheSettingsWithinAHundredth) {
  const ReplaySettings settings = UnitSettings();
  const auto reason_at = [&](const auto& add, double limit) {
    MotionMonitor monitor(settings);
    monitor.Start(Pose(0, 0));
    add(monitor, limit * settings.diameter_m);
    return monitor.reason();
  };
  const auto move = [](MotionMonitor& monitor, double x) { monitor.AddPose(Pose(x, 0)); };
  const auto turn = [](MotionMonitor& monitor, double x) { monitor.AddPose(Pose(0, x)); };
  const auto slip = [](MotionMonitor& monitor, double x) { monitor.AddSlip(FingerIndex(0), x); };
  const auto gap = [](MotionMonitor& monitor, double x) { monitor.AddGap(FingerIndex(0), x); };
  for (const double share : {0.99, 1.01}) {
    const auto expected = [&](plan::Reason reason) {
      return share > 1 ? reason : plan::Reason::kNone;
    };
    const double limit = share * settings.tolerance;
    EXPECT_EQ(reason_at(move, limit), expected(plan::Reason::kObjectMoved));
    EXPECT_EQ(reason_at(turn, limit), expected(plan::Reason::kObjectMoved));  // at a radius of 1
    EXPECT_EQ(reason_at(slip, limit), expected(plan::Reason::kSlipped));
    EXPECT_EQ(reason_at(gap, share * kLostGap), expected(plan::Reason::kContactLost));
  }
}

TEST(MotionMonitorTest, ALostContactComesBeforeASlipBeforeAMotion) {
  MotionMonitor monitor(UnitSettings());
  monitor.AddPose(Pose(1, 0));
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved);
  monitor.AddSlip(FingerIndex(2), 0.0019);
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved);
  monitor.AddSlip(FingerIndex(2), 0.0021);
  EXPECT_EQ(monitor.reason(), plan::Reason::kSlipped);
  monitor.AddGap(FingerIndex(3), 1e-6);
  EXPECT_FALSE(monitor.contact_lost());
  monitor.AddGap(FingerIndex(3), 1e-4);
  EXPECT_EQ(monitor.reason(), plan::Reason::kContactLost);
  EXPECT_NE(monitor.detail().find("finger 3"), std::string::npos);
  monitor.Start(Pose(0, 0));
  EXPECT_EQ(monitor.reason(), plan::Reason::kNone);
  EXPECT_TRUE(monitor.detail().empty());
}

TEST(MotionMonitorTest, TellsHowFarAndWhenItWasSeenFirst) {
  MotionMonitor monitor(UnitSettings());
  monitor.SetPhase("during the sliding step");
  monitor.AddPose(Pose(0, 0));
  monitor.AddPose(Pose(0.004, 0));
  EXPECT_EQ(monitor.detail(), "the object moves 4 mm and rotates 0° during the sliding step");
  monitor.AddSlip(FingerIndex(2), 0.003);
  monitor.SetPhase("under a disturbance force of 5.3 N along +x");
  monitor.AddSlip(FingerIndex(1), 0.007);
  monitor.AddSlip(FingerIndex(2), 0.0045);
  EXPECT_EQ(monitor.detail(), "finger 2 slips 4.5 mm during the sliding step");
  EXPECT_EQ(monitor.slip_m(), 0.007);
  monitor.AddGap(FingerIndex(3), 1e-4);
  EXPECT_EQ(monitor.detail(),
            "finger 3 is 100 µm off the surface under a disturbance force of 5.3 N along +x");
}

TEST(MotionMonitorTest, WhatExceedsTheToleranceIsNotToldEqualToIt) {
  const ReplaySettings settings = UnitSettings();
  const double limit = settings.tolerance * settings.diameter_m;
  int checked = 0;
  for (double more = 1; more > 1e-9; more /= 10) {
    MotionMonitor monitor(settings);
    monitor.SetPhase("now");
    monitor.AddSlip(FingerIndex(1), limit * (1 + more));
    monitor.AddSlip(FingerIndex(1), 0);
    ASSERT_EQ(monitor.reason(), plan::Reason::kSlipped);
    EXPECT_EQ(monitor.detail().find(" " + FormatLength(limit) + " "), std::string::npos)
        << monitor.detail();
    MotionMonitor moved(settings);
    moved.SetPhase("now");
    moved.Start(Pose(0, 0));
    moved.AddPose(Pose(limit * (1 + more), 0));
    EXPECT_EQ(moved.detail().find(" " + FormatLength(limit) + " "), std::string::npos)
        << moved.detail();
    ++checked;
  }
  EXPECT_GE(checked, 9);
}

TEST(MotionMonitorTest, TheGiveOfTheServosIsNoMotion) {
  MotionMonitor monitor(UnitSettings());
  monitor.Start(Pose(0, 0));
  monitor.SetGiving(true);
  monitor.AddPose(Pose(0.1, 0));
  monitor.SetGiving(false);
  monitor.AddPose(Pose(0.0005, 0));
  EXPECT_EQ(monitor.reason(), plan::Reason::kNone);
  EXPECT_NEAR(monitor.give_m(), 0.1, 1e-12);
  EXPECT_NEAR(monitor.moved_m(), 0.0005, 1e-12);
  monitor.AddPose(Pose(0.1, 0));
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved)
      << "an object that does not come back has moved";
}

TEST(MotionMonitorTest, MotionIsTheLargestSumOfShiftAndTurnNotTheSumOfTheLargest) {
  MotionMonitor monitor(UnitSettings());
  monitor.Start(Pose(0, 0));
  monitor.AddPose(Pose(0.0006, 0));
  monitor.AddPose(Pose(0, 0.0008));
  EXPECT_NEAR(monitor.moved_m(), 0.0008, 1e-9);
  EXPECT_NEAR(monitor.displacement_m() + monitor.rotation_rad(), 0.0014, 1e-9);
  EXPECT_EQ(monitor.reason(), plan::Reason::kNone);
}

TEST(MotionMonitorTest, TheSmallestConeMarginOfEveryFingerThatPressesStays) {
  ReplaySettings settings = UnitSettings();
  settings.mu = 1;
  settings.grasp_force_N = 10;
  MotionMonitor monitor(settings);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  monitor.AddForce(FingerIndex(0), {0, 0, 5}, up);
  monitor.AddForce(FingerIndex(1), {0, 2, 2}, up);
  monitor.AddForce(FingerIndex(1), {0, 0, 2}, up);
  monitor.AddForce(FingerIndex(2), {0, 0.004, 0.004}, up);  // small normal force
  ASSERT_EQ(monitor.margins().size(), 2u);
  EXPECT_NEAR(monitor.margins().at(FingerIndex(0)), std::atan(1.0), 1e-12);
  EXPECT_NEAR(monitor.margins().at(FingerIndex(1)), 0, 1e-12);
  monitor.ForgetForces();
  EXPECT_TRUE(monitor.margins().empty());
}

TEST(MotionMonitorTest, MarginsAreTheLeastOfAllForces) {
  ReplaySettings settings = UnitSettings();
  settings.mu = 0.5;
  settings.grasp_force_N = 1;
  MotionMonitor monitor(settings);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d tangent = normal.unitOrthogonal();
  FingerMargins expected;
  for (int i = 0; i < 1000; ++i) {
    const FingerIndex finger(i % 3);
    // Oscillations that grow and fade, and finally repeat nearly the same force.
    const double slope = i < 900 ? 0.5 * std::sin(0.01 * i) * std::cos(0.37 * i) : 0.3 + 1e-15 * i;
    const double twist = finger == FingerIndex(2) ? 0.05 * std::abs(slope) : 0;
    const Eigen::Vector3d force = (2 + std::sin(i)) * (normal + slope * tangent);
    monitor.AddForce(finger, force, normal, twist);
    AddMargin(finger, ConeMargin(force, normal, std::atan(settings.mu), twist), expected);
  }
  constexpr double kRoundings = 1e-15;  // rounding error of an angle, radians
  const FingerMargins margins = monitor.margins();
  ASSERT_EQ(margins.size(), expected.size());
  for (const auto& [finger, margin] : expected) EXPECT_NEAR(margins.at(finger), margin, kRoundings);
}

}  // namespace motion_monitor_test
}  // namespace regrasp::sim
