// Replays of soft fingers: contacts with torsional friction.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <string>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"
#include "sim/world/motion_monitor.h"
#include "tests/fixtures/solids.h"
#include "tests/sim/mujoco_file.h"
#include "tests/sim/replay/replay_expectations.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace soft_fingers_test {

constexpr double kDegrees = 25;

/// Return a plan with two fingers on opposite faces of the cube, the second offset from the line of
/// the first.
plan::Plan PairOnCube(const CubeCase& cube, double torsion, double offset = 0,
                      double degrees = kDegrees) {
  plan::Plan plan = MakePlan({cube.At(0, -0.03, 0, 0), cube.At(1, 0.03, offset, 0)}, degrees, 3);
  plan::SetTorsion(torsion, plan);
  return plan;
}

plan::Reason ReasonOf(const CubeCase& cube, const plan::Plan& plan,
                      const ReplayOptions& options = {}) {
  return ReplayPlan(cube.object, plan, options).steps.at(0).reason;
}

/// Return the torsional friction length for a pair with a given quality.
/// The quality is `times_shake` times the disturbance. The pair resists μ torsion / R about its
/// line.
double TorsionFor(const CubeCase& cube, double times_shake) {
  const double radius = cube.object.diameter() / 2;
  return times_shake * ReplayOptions().disturbance_ratio * radius / std::tan(Radians(kDegrees));
}

TEST(SoftFingersReplay, TwoHoldACubeAndHardPointsLoseIt) {
  const CubeCase cube;
  ExpectGood(ReplayPlan(cube.object, PairOnCube(cube, 0.01), {}), 1);
  EXPECT_TRUE(LosesObject(ReasonOf(cube, PairOnCube(cube, 0))));
}

TEST(SoftFingersReplay, WhatTheyResistAboutTheirLineIsTheTorsionThatTheyHave) {
  // The analytic quality is this torque, so the disturbance is below or above it.
  const CubeCase cube;
  int held = 0, lost = 0;
  for (const double times : {0.8, 0.95, 1.05, 1.25}) {
    const double torsion = TorsionFor(cube, times);
    const plan::Plan plan = PairOnCube(cube, torsion);
    const grasp::QualityBounds quality = grasp::ComputeQuality(
        plan::ContactsOf(plan.initial), cube.object.wrench_frame(), plan.friction_angle, 0.2);
    EXPECT_LE(quality.lower, times * ReplayOptions().disturbance_ratio * (1 + 1e-9));
    EXPECT_GE(quality.upper, times * ReplayOptions().disturbance_ratio * (1 - 1e-9));
    const plan::Reason reason = ReasonOf(cube, plan);
    if (times < 1) {
      EXPECT_TRUE(LosesObject(reason)) << times;
      ++lost;
    } else {
      EXPECT_EQ(reason, plan::Reason::kNone) << times;
      ++held;
    }
  }
  EXPECT_EQ(held, 2);
  EXPECT_EQ(lost, 2);
}

TEST(SoftFingersReplay, TheLargestPushInEveryDirectionIsThatOfTheAnalysis) {
  const CubeCase cube;
  ReplayOptions options;
  options.resisted_wrench = true;
  options.gravity = false;
  const ReplayResult result = ReplayPlan(cube.object, PairOnCube(cube, 0.02), options);
  ASSERT_EQ(result.steps.at(0).reason, plan::Reason::kNone);
  ASSERT_EQ(result.steps[0].resisted_wrench.size(), 12U);
  for (const ResistedWrench& direction : result.steps[0].resisted_wrench) {
    EXPECT_NEAR(direction.replay, direction.analysis, 0.05 * direction.analysis);
  }
}

TEST(SoftFingersReplay, AWeightTakesOfTheTorqueAboutTheLineWhatTheEllipseSays) {
  // The weight takes a share s of the friction, so that √(1 − s²) of it remains for the torque.
  const CubeCase cube;
  const double torsion = 0.02, mu = std::tan(Radians(kDegrees));
  ReplayOptions options;
  options.resisted_wrench = true;
  options.mass_kg = 0.2;
  for (const double share : {0.4, 0.8}) {
    options.grasp_force_N = *options.mass_kg * kGravity / (share * mu);
    const ReplayResult result = ReplayPlan(cube.object, PairOnCube(cube, torsion), options);
    ASSERT_EQ(result.steps.at(0).reason, plan::Reason::kNone);
    const double radius = cube.object.diameter() / 2;
    const double expected = mu * torsion / radius * std::sqrt(1 - share * share);
    int about_line = 0;
    for (const ResistedWrench& direction : result.steps[0].resisted_wrench) {
      const grasp::Wrench disturbance = DisturbanceWrench(direction.disturbance, 1);
      if (std::abs(disturbance.torque_over_radius.x()) != 1) continue;
      ++about_line;
      EXPECT_NEAR(direction.analysis, expected, 1e-6);
      EXPECT_NEAR(direction.replay, expected, 0.05 * expected);
    }
    EXPECT_EQ(about_line, 2);
  }
}

TEST(SoftFingersReplay, FailsBelowTheFrictionThatTheOffsetNeeds) {
  const CubeCase cube;
  const double offset = 0.012;
  const auto required = grasp::ComputeRequiredFrictionAngle(
      plan::ContactsOf(PairOnCube(cube, 0.02, offset).initial), cube.object.wrench_frame());
  ASSERT_TRUE(required);
  EXPECT_NEAR(required->upper, std::atan(offset / 0.06), 1e-6);
  const auto at = [&](double share) {
    return PairOnCube(cube, 0.02, offset, Degrees(std::atan(share * std::tan(required->upper))));
  };
  EXPECT_TRUE(LosesObject(ReasonOf(cube, at(0.9))));
  EXPECT_EQ(ReasonOf(cube, at(1.5)), plan::Reason::kNone);
}

TEST(SoftFingersReplay, TheSceneHasTheEnginesTorsionalFrictionAndHardPointsNone) {
  const CubeCase cube;
  const double torsion = 0.004;
  const plan::Plan plan = PairOnCube(cube, torsion);
  const auto soft = LoadFromFile(SceneMjcf(cube.object, plan, {}));
  const auto hard = LoadFromFile(SceneMjcf(cube.object, PairOnCube(cube, 0), {}));
  ASSERT_NE(soft, nullptr);
  ASSERT_NE(hard, nullptr);
  const double mu = std::tan(plan.friction_angle);
  EXPECT_EQ(soft->opt.cone, mjCONE_ELLIPTIC);
  for (int geom = 0; geom < soft->ngeom; ++geom) {
    EXPECT_EQ(soft->geom_condim[geom], 4);
    EXPECT_DOUBLE_EQ(soft->geom_friction[3 * geom], mu);
    EXPECT_DOUBLE_EQ(soft->geom_friction[3 * geom + 1], mu * torsion);
    EXPECT_EQ(hard->geom_condim[geom], 3);
  }
  EXPECT_EQ(ReplayPlan(cube.object, plan, {}).settings.torsion_m, torsion);
}

TEST(SoftFingersReplay, TheUnitOfLengthDoesNotMatter) {
  // The same cube in millimetres.
  const object::Polyhedron large = MakeCube(30);
  plan::Plan plan = MakePlan({{FingerIndex(0), ContactAt(large, {-30, 0, 0}, {1, 0, 0})},
                              {FingerIndex(1), ContactAt(large, {30, 4, 0}, {-1, 0, 0})}},
                             kDegrees, 3);
  plan.scale = 1e-3;
  plan::SetTorsion(5, plan);
  const ReplayResult result = ReplayPlan(large, plan, {});
  ExpectGood(result, 1);
  EXPECT_NEAR(result.settings.torsion_m, 0.005, 1e-15);
}

TEST(SoftFingersReplay, ATwoFingerSequencePasses) {
  const CubeCase cube;
  plan::Plan plan = PairOnCube(cube, 0.01);
  plan.steps = {plan::Switch{{cube.At(2, 0.002, 0.03, 0.001)}, {}},
                plan::Switch{{}, {FingerIndex(0)}}};
  // Fingers 1 and 2 alone, on perpendicular faces, are not force closure.
  plan::SetTorsion(0.01, plan);
  EXPECT_TRUE(LosesObject(ReplayPlan(cube.object, plan, {}).steps.back().reason));
  plan.fingers = 4;
  plan.steps = {plan::Switch{{cube.At(2, 0, -0.03, 0.001), cube.At(3, 0.001, 0.03, 0)},
                             {FingerIndex(0), FingerIndex(1)}}};
  plan::SetTorsion(0.01, plan);
  ExpectGood(ReplayPlan(cube.object, plan, {}), 2);
}

TEST(SoftFingersReplay, TheMarginCountsTheTorqueAsATangentialForce) {
  const Eigen::Vector3d n = Eigen::Vector3d::UnitX();
  const double friction_angle = Radians(30);
  EXPECT_EQ(ConeMargin({1, 0.3, 0}, n, friction_angle, 0),
            ConeMargin({1, 0.3, 0}, n, friction_angle));
  EXPECT_NEAR(ConeMargin({1, 0.3, 0}, n, friction_angle, 0.4), friction_angle - std::atan(0.5),
              1e-15);
  const CubeCase cube;
  const StepReplay step =
      ReplayPlan(cube.object, PairOnCube(cube, TorsionFor(cube, 1.1)), {}).steps.at(0);
  ASSERT_EQ(step.reason, plan::Reason::kNone);
  ASSERT_TRUE(step.adapted);
  const auto least = SmallestMargin(step.adapted->disturbance_margins);
  ASSERT_TRUE(least);
  // The disturbance about the line takes almost all of the friction.
  EXPECT_GT(*least, 0);
  EXPECT_LT(*least, Radians(5));
}

TEST(SoftFingersReplay, TwiceGivesTheSameBits) {
  const CubeCase cube;
  plan::Plan plan = PairOnCube(cube, 0.01, 0.004);
  plan.steps = {plan::Switch{{cube.At(2, 0.002, 0.03, 0.001)}, {}}};
  plan::SetTorsion(0.01, plan);
  ExpectSameBitsTwice(cube.object, plan);
}

}  // namespace soft_fingers_test
}  // namespace regrasp::sim
