#include "sim/replay/disagreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check.h"
#include "sim/scene/scaling.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace disagreement_test {

using testing::HasSubstr;

/// Initial grasp with findings chosen by the test; by default analysis and replay both pass.
struct Hold {
  const object::Object& object;
  plan::Plan plan;
  plan::StepCheck check = {};
  StepReplay replay = {};
  ReplaySettings settings = {};

  Hold(const object::Object& body, plan::Plan held, const ReplayOptions& options = {})
      : object(body), plan(std::move(held)) {
    settings = DeriveSettings(object, plan.scale, plan.friction_angle, object.diameter(), options);
    replay.adapted = replay.fixed = StepMotion();
  }
  [[nodiscard]] std::optional<Disagreement> Explain() const {
    return ExplainDisagreement({object, plan, check, replay, settings});
  }
  /// Return the explanation if the replay fails.
  [[nodiscard]] Disagreement ExplainFailure(plan::Reason reason = plan::Reason::kSlipped) {
    replay.reason = replay.adapted->reason = reason;
    return Explain().value();
  }
};

double ValueOf(const Disagreement& found, const std::string& name) {
  const auto value =
      std::ranges::find(found.values, name, [](const auto& entry) { return entry.first; });
  EXPECT_NE(value, found.values.end()) << name;
  return value == found.values.end() ? -1 : value->second;
}

TEST(DisagreementTest, WhereTheExaminationsAgreeThereIsNothingToExplain) {
  const CubeCase cube;
  Hold hold(cube.object, MakePlan(cube.Start(), 25));
  EXPECT_FALSE(hold.Explain());
  hold.check.reason = plan::Reason::kNotForceClosure;
  hold.replay.reason = hold.replay.adapted->reason = plan::Reason::kSlipped;
  hold.replay.fixed->reason = plan::Reason::kContactLost;
  EXPECT_FALSE(hold.Explain()) << "both fail";
  hold.check = {};
  hold.check.skipped = true;
  EXPECT_FALSE(hold.Explain());
}

TEST(DisagreementTest, AQualityBelowTheShakeIsNamedWithBothNumbers) {
  const CubeCase cube;
  // The grasp requires 5.3°.
  Hold hold(cube.object, MakePlan(cube.Start(), 5.6));
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.between, Between::kReplayFails);
  EXPECT_EQ(found.cause, Cause::kQuality);
  EXPECT_GT(ValueOf(found, "quality"), 0);
  EXPECT_LT(ValueOf(found, "quality"), 0.01);
  EXPECT_EQ(ValueOf(found, "shake"), 0.01);
  EXPECT_THAT(found.text, HasSubstr("ε = "));
}

TEST(DisagreementTest, AContactInAConcaveCornerIsNamed) {
  const object::Polygon shape = MakeL();
  const plan::FingerGrasp grasp = {OnEdge(shape, 0, 2, 1 - 1e-7), OnEdge(shape, 1, 0, 0.5),
                                   OnEdge(shape, 2, 5, 0.5)};
  Hold hold(shape, MakePlanarPlan(grasp, 25));
  const Disagreement found = hold.ExplainFailure(plan::Reason::kUnreachable);
  EXPECT_EQ(found.cause, Cause::kConcaveCorner);
  EXPECT_EQ(ValueOf(found, "finger"), 0);
  EXPECT_NEAR(ValueOf(found, "border_m"), 0.04 * 1e-7, 1e-12);
}

TEST(DisagreementTest, AFingertipThickerThanTheHoleHasNoClearance) {
  const object::Polygon frame = MakeFrame();
  // Fingers press outwards from inside the hole, which has a side of 4 cm.
  const plan::FingerGrasp grasp = {OnEdge(frame, 0, 4, 0.5), OnEdge(frame, 1, 6, 0.5)};
  Hold hold(frame, MakePlanarPlan(grasp, 25));
  EXPECT_NE(hold.ExplainFailure().cause, Cause::kNoClearance);
  hold.settings.fingertip_radius_m = 0.03;
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.cause, Cause::kNoClearance);
  EXPECT_NEAR(ValueOf(found, "clearance_m"), 0.02, 1e-9);
  EXPECT_NEAR(ValueOf(found, "fingertip_radius_m"), 0.03, 1e-12);
}

TEST(DisagreementTest, AWeightThatTheGraspForceDoesNotCarryIsNamed) {
  const CubeCase cube;
  ReplayOptions options;
  options.grasp_force_N = 3;  // for a weight of 2.1 N, at friction 0.47
  Hold hold(cube.object, MakePlan(cube.Start(), 25), options);
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.cause, Cause::kWeight);
  EXPECT_GT(ValueOf(found, "weight"), ValueOf(found, "carried"));
}

TEST(DisagreementTest, AWeightThatLeavesTooLittleForTheShakeIsNamed) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  const double carried =
      grasp::ComputeLargestLoad(plan::ContactsOf(plan.initial), cube.object.wrench_frame(),
                                plan.friction_angle, {}, {-Eigen::Vector3d::UnitZ(), {0, 0, 0}}, 1)
          ->lower;
  ReplayOptions options;
  options.mass_kg = 0.2;
  options.grasp_force_N = 0.2 * kGravity / (carried - 0.005);
  Hold hold(cube.object, plan, options);
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.cause, Cause::kWeight);
  EXPECT_LT(ValueOf(found, "resisted"), 0.01);
  EXPECT_GE(ValueOf(found, "resisted"), 0);
}

TEST(DisagreementTest, AContactThatMaySlipOverAnEdgeIsNamed) {
  const CubeCase cube;
  plan::FingerGrasp grasp = cube.Start();
  grasp[1] = cube.At(1, -0.03, 0.02995, 0.004);
  Hold hold(cube.object, MakePlan(grasp, 40));
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.cause, Cause::kEdge);
  EXPECT_EQ(ValueOf(found, "finger"), 1);
  EXPECT_NEAR(ValueOf(found, "border_m"), 5e-5, 1e-12);
  EXPECT_GT(ValueOf(found, "allowed_slip_m"), 5e-5);
}

TEST(DisagreementTest, AForceThatReachedItsConeIsNamedWithItsFingerAndItsTime) {
  const CubeCase cube;
  Hold hold(cube.object, MakePlan(cube.Start(), 25));
  hold.replay.motion_margins = {{FingerIndex(0), 0.1}, {FingerIndex(2), 0.2}};
  hold.replay.static_margins = {{FingerIndex(0), 0.1}, {FingerIndex(2), 1e-5}};
  const Disagreement found = hold.ExplainFailure();
  EXPECT_EQ(found.cause, Cause::kConeReached);
  EXPECT_EQ(ValueOf(found, "finger"), 2);
  EXPECT_THAT(found.text, HasSubstr("in the static grasp"));
}

TEST(DisagreementTest, WhereNothingSpeaksForACauseNoneIsClaimed) {
  const CubeCase cube;
  Hold hold(cube.object, MakePlan(cube.Start(), 25));
  EXPECT_EQ(hold.ExplainFailure().cause, Cause::kUnknown);
}

TEST(DisagreementTest, APassOfWhatTheAnalysisFailsHasItsOwnCauses) {
  const CubeCase cube;
  Hold hold(cube.object, MakePlan(cube.Start(), 20));
  hold.check.reason = plan::Reason::kWrongNormal;
  Disagreement found = hold.Explain().value();
  EXPECT_EQ(found.between, Between::kAnalysisFails);
  EXPECT_EQ(found.cause, Cause::kNotSimulated);
  hold.check.reason = plan::Reason::kNotForceClosure;
  hold.check.required = grasp::RequiredFrictionAngle{Radians(20.1), Radians(20.1)};
  EXPECT_EQ(hold.Explain()->cause, Cause::kRequiredFriction);
  hold.check.required = grasp::RequiredFrictionAngle{Radians(25), Radians(25)};
  EXPECT_EQ(hold.Explain()->cause, Cause::kUnknown);
  hold.settings.disturbance_ratio = 0;
  EXPECT_EQ(hold.Explain()->cause, Cause::kNoDisturbance);
}

TEST(DisagreementTest, AReplayThatPassesAGraspThatTheAnalysisRefusesSaysWhy) {
  const CubeCase cube;
  // So close to the required friction, the missing force does not move the object without a
  // disturbance.
  const double required = grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(cube.Start()),
                                                              cube.object.wrench_frame())
                              ->lower;
  const plan::Plan plan = MakePlan(cube.Start(), Degrees(0.9999 * required));
  ReplayOptions options;
  options.disturbance_ratio = 0;
  options.gravity = false;
  const plan::PlanCheck check = plan::CheckPlan(cube.object, plan, {});
  EXPECT_EQ(check.steps.at(0).reason, plan::Reason::kNotForceClosure);
  const ReplayResult replay = ReplayPlan(cube.object, check.projected, options);
  EXPECT_EQ(replay.steps.at(0).reason, plan::Reason::kNone);
  const auto found = ExplainDisagreement(
      {cube.object, check.projected, check.steps[0], replay.steps[0], replay.settings});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->between, Between::kAnalysisFails);
  EXPECT_EQ(found->cause, Cause::kNoDisturbance);
}

/// Initial grasp replayed by both engines.
struct HoldOfTwo : Hold {
  using Hold::Hold;

  [[nodiscard]] std::optional<Disagreement> Compare(plan::Reason mujoco, plan::Reason ode,
                                                    const FingerMargins& ode_margins = {}) {
    replay.reason = mujoco;
    replay.ode = StepMotion();
    replay.ode->disturbance_margins = ode_margins;
    replay.ode->reason = ode;
    replay.ode->detail = "what ODE says";
    return ExplainEngines({object, plan, check, replay, settings});
  }
};

constexpr plan::Reason kPasses = plan::Reason::kNone;

TEST(EnginesTest, WhereTheyAgreeOrOneHasNotRunThereIsNothingToExplain) {
  const CubeCase cube;
  HoldOfTwo hold(cube.object, MakePlan(cube.Start(), 25));
  EXPECT_FALSE(ExplainEngines({hold.object, hold.plan, hold.check, hold.replay, hold.settings}));
  EXPECT_FALSE(hold.Compare(kPasses, kPasses));
  EXPECT_FALSE(hold.Compare(plan::Reason::kSlipped, plan::Reason::kContactLost)) << "both fail";
  hold.check.skipped = true;
  EXPECT_FALSE(hold.Compare(kPasses, plan::Reason::kSlipped));
}

TEST(EnginesTest, SayWhichOfThemFails) {
  const CubeCase cube;
  HoldOfTwo hold(cube.object, MakePlan(cube.Start(), 25));
  EXPECT_EQ(hold.Compare(kPasses, plan::Reason::kSlipped).value().between, Between::kOdeFails);
  EXPECT_EQ(hold.Compare(plan::Reason::kSlipped, kPasses).value().between, Between::kOdePasses);
}

TEST(EnginesTest, FrictionNearTheCriticalOneComesFirstAndAWeakGraspNext) {
  const CubeCase cube;
  // The grasp requires 5.3°.
  HoldOfTwo hold(cube.object, MakePlan(cube.Start(), 5.4));
  const auto required = grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(cube.Start()),
                                                            cube.object.wrench_frame());
  hold.check.required = required;
  hold.settings.mu = 1.01 * std::tan(required->upper);
  const Disagreement near = hold.Compare(kPasses, plan::Reason::kSlipped).value();
  EXPECT_EQ(near.cause, Cause::kRequiredFriction);
  EXPECT_THAT(near.text, HasSubstr("1.01 times the required one"));
  hold.settings.mu = 1.04 * std::tan(required->upper);
  EXPECT_EQ(hold.Compare(kPasses, plan::Reason::kSlipped).value().cause, Cause::kQuality);
}

TEST(EnginesTest, AnEngineThatDoesNotComeThroughIsNamed) {
  const CubeCase cube;
  HoldOfTwo hold(cube.object, MakePlan(cube.Start(), 25));
  const auto found = hold.Compare(kPasses, plan::Reason::kSimulationUnstable);
  EXPECT_EQ(found.value().cause, Cause::kUnstable);
  EXPECT_THAT(found->text, HasSubstr("ODE did not converge: what ODE says"));
}

TEST(EnginesTest, TheForcesOfTheEngineThatFailsAreLookedAt) {
  const CubeCase cube;
  HoldOfTwo hold(cube.object, MakePlan(cube.Start(), 25));
  EXPECT_EQ(hold.Compare(kPasses, plan::Reason::kSlipped).value().cause, Cause::kUnknown);
  hold.replay.disturbance_margins = {{FingerIndex(1), 0.0}};
  EXPECT_EQ(hold.Compare(kPasses, plan::Reason::kSlipped).value().cause, Cause::kUnknown)
      << "MuJoCo's";
  const auto reached = hold.Compare(kPasses, plan::Reason::kSlipped, {{FingerIndex(1), 0.0}});
  EXPECT_EQ(reached.value().cause, Cause::kConeReached);
}

}  // namespace disagreement_test
}  // namespace regrasp::sim
