#include "sim/validation/validation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/certificate/align_certificate.h"
#include "planner/plan/projection.h"
#include "tests/sim/actuation/held_in_hand.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::validation {
namespace validation_test {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::StartsWith;

/// The cube, and a plan that holds it.
class Validation : public testing::Test {
 protected:
  Validation() { plan_.goal = plan::ContactsOf(plan_.initial); }

  [[nodiscard]] ValidationResult Run(const ValidationOptions& options) const {
    return Validate({.object = cube_.object, .plan = plan_, .options = options});
  }

  sim::CubeCase cube_;
  plan::Plan plan_ = sim::MakePlan(cube_.Start(), 25);
};

TEST_F(Validation, SettingsAreThoseOfTheRequestOrElseOfThePlan) {
  plan_.finger_radius = 0.001;
  const ValidationRequest plain{.object = cube_.object, .plan = plan_};
  const ValidationSettings of_plan = ResolveSettings(plain);
  EXPECT_EQ(of_plan.plan.friction_angle, plan_.friction_angle);
  EXPECT_EQ(of_plan.plan.torsion, 0);
  EXPECT_EQ(of_plan.plan.finger_radius, 0.001);
  EXPECT_FALSE(of_plan.hand);
  ValidationRequest request = plain;
  request.options.friction_angle = Radians(30);
  request.options.torsion = 0.002;
  request.options.replay.finger_radius = 0.003;
  const ValidationSettings requested = ResolveSettings(request);
  EXPECT_EQ(requested.plan.friction_angle, Radians(30));
  EXPECT_EQ(requested.plan.torsion, 0.002);
  EXPECT_EQ(requested.plan.initial[0].contact.torsion, 0.002);
  EXPECT_EQ(requested.plan.finger_radius, 0.003);
}

TEST_F(Validation, TheReportNamesTheSettings) {
  ValidationOptions options;
  options.friction_angle = Radians(30);
  options.torsion = 0.002;
  options.replay.finger_radius = 0.003;
  const Report report = Run(options).report;
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.friction_angle, Radians(30));
  EXPECT_EQ(report.torsion, 0.002);
  EXPECT_EQ(report.finger_radius, 0.003);
  EXPECT_EQ(report.settings->torsion_m, 0.002);
  EXPECT_EQ(report.settings->fingertip_radius_m, 0.003);
}

TEST_F(Validation, TheReplayHasTheRequestedFriction) {
  for (const double degrees : {25, 30}) {
    ValidationOptions options;
    if (degrees != 25) options.friction_angle = Radians(degrees);
    const Report report = Run(options).report;
    ASSERT_TRUE(report.settings);
    EXPECT_NEAR(report.settings->mu, std::tan(Radians(degrees)), 1e-12);
  }
}

TEST_F(Validation, CertificatesAreCheckedAtTheRequestedFriction) {
  plan::Align align{{cube_.Start(), cube_.Start()}};
  align.waypoints[1][0] = cube_.At(0, 0.03, 0.006, 0.002);
  plan_.goal = plan::ContactsOf(align.waypoints[1]);
  plan_.steps = {align};
  certificate::AddCertificates(cube_.object, plan_);
  const plan::Plan projected = plan::ProjectPlan(cube_.object, plan_);
  const auto& proved = std::get<plan::Align>(projected.steps[0]);
  ASSERT_TRUE(proved.certificate);
  double refused = 0, holds = std::tan(Radians(25));
  while (holds - refused > 1e-6) {
    const double mu = (refused + holds) / 2;
    const bool proves =
        certificate::CheckAlignCertificate(proved, 3, mu, *proved.certificate).proves();
    (proves ? holds : refused) = mu;
  }
  for (const double share : {0.99, 1.01}) {
    ValidationOptions options;
    options.friction_angle = std::atan(share * holds);
    const Report report = Run(options).report;
    ASSERT_TRUE(report.steps[1].certificate) << report.steps[0].detail();
    EXPECT_EQ(report.steps[1].certificate->proves(), share > 1) << share;
  }
}

TEST_F(Validation, StepsAfterAFailureAreSkippedAndNotReplayed) {
  plan::Switch off_surface;
  off_surface.place = {cube_.At(3, 0.03, 0.5, 0)};
  plan_.steps = {off_surface, plan::Switch()};
  const Report report = Run({}).report;
  ASSERT_EQ(report.steps.size(), 3u);
  EXPECT_EQ(report.steps[0].verdict(), Verdict::kPass);
  EXPECT_EQ(report.steps[1].verdict(), Verdict::kFail);
  EXPECT_FALSE(report.steps[1].replay);
  EXPECT_EQ(report.steps[2].verdict(), Verdict::kSkipped);
}

TEST_F(Validation, TrialsAndProofsAreMadeOnRequestAndTrialsOnlyOfWhatPasses) {
  EXPECT_FALSE(Run({}).report.trials);
  EXPECT_FALSE(Run({}).report.steps[0].proof);
  ValidationOptions options;
  options.trials.count = 2;
  options.certificates = true;
  std::vector<std::string> stages;
  const auto validate = [&] {
    stages.clear();
    return Validate({.object = cube_.object, .plan = plan_, .options = options},
                    {.on_stage = [&](const std::string& text) { stages.push_back(text); }})
        .report;
  };
  const Report passing = validate();
  ASSERT_TRUE(passing.trials);
  EXPECT_EQ(passing.trials->options.count, 2);
  EXPECT_TRUE(passing.steps[0].proof);
  EXPECT_THAT(stages, ElementsAre("checking the plan", "replay: 1 of 1 steps", "trials: 1 of 2",
                                  "trials: 2 of 2"));
  options.friction_angle = Radians(1);
  const Report failing = validate();
  EXPECT_FALSE(failing.passed());
  EXPECT_FALSE(failing.trials);
  EXPECT_THAT(stages, Not(Contains(StartsWith("trials"))));
}

TEST_F(Validation, AGraspIsMeasured) {
  const plan::Plan hold =
      MakeHoldPlan(cube_.object, plan::ContactsOf(plan_.initial), Radians(25), 1);
  const Report report = Validate({.object = cube_.object, .plan = hold, .is_grasp = true}).report;
  EXPECT_TRUE(report.passed());
  ASSERT_TRUE(report.grasp);
  EXPECT_EQ(report.grasp->fingers.size(), plan_.initial.size());
  EXPECT_GT(report.grasp->quality.lower, 0);
  EXPECT_FALSE(Run({}).report.grasp);
}

class ValidationByHand : public sim::HeldInHand {};

TEST_F(ValidationByHand, TheHandExecutesThePlanUnlessPointFingersAreRequested) {
  ValidationOptions options;
  options.hand.tolerance.length_m = 3e-3;
  options.replay.disturbance_ratio = 0.02;
  options.replay.mass_kg = kMass;
  const ValidationRequest request{
      .object = solid(), .plan = plan_, .hand = &hand_, .options = options};
  const Report by_hand = Validate(request).report;
  EXPECT_TRUE(by_hand.passed());
  ASSERT_TRUE(by_hand.settings->hand);
  EXPECT_EQ(by_hand.settings->hand->tolerance.length_m, 3e-3);
  EXPECT_EQ(by_hand.settings->disturbance_ratio, 0.02);
  EXPECT_EQ(by_hand.settings->mass_kg, kMass);
  ValidationRequest points = request;
  points.options.replay_by_hand = false;
  const Report by_points = Validate(points).report;
  EXPECT_TRUE(by_points.passed());
  EXPECT_FALSE(by_points.settings->hand);
}

TEST_F(ValidationByHand, TheHandIsChecked) {
  plan::Plan broken = plan_;
  broken.hand->initial.joints[FingerIndex(0)][0] += 0.3;
  const ValidationRequest request{.object = solid(), .plan = broken, .hand = &hand_};
  EXPECT_FALSE(Validate(request).report.passed());
  EXPECT_FALSE(Validate(request).report.steps[0].replay);
  ValidationRequest without = request;
  without.hand = nullptr;
  EXPECT_TRUE(Validate(without).report.passed());
}

TEST_F(ValidationByHand, APlanarObjectIsRefused) {
  const object::ObjectFile square = ReadModel("square.wkt");
  EXPECT_THROW((void)Validate({.object = *square.object, .plan = plan_, .hand = &hand_}),
               InputError);
}

}  // namespace validation_test
}  // namespace regrasp::validation
