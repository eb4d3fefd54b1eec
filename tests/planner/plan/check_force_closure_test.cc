// Position of a loss of force closure and required friction angle, as reported by the plan checker.

#include <gtest/gtest.h>

#include <cmath>

#include "check_expectations.h"
#include "planner/base/number.h"
#include "planner/plan/check.h"
#include "sample_plans.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace check_force_closure_test {

TEST(CheckPlan, LosesForceClosureExactlyWhereTwoFingersDo) {
  // Two opposite fingers with a lateral offset s hold a square of side 2 iff s/2 < tan θ.
  const object::Polygon square = MakeSquare();
  Plan plan = EmptyPlan(2, 4, 20);
  const double limit = 2 * std::tan(plan.friction_angle);
  for (const double share : {1 - 1e-6, 1 + 1e-6}) {
    plan.initial = {{FingerIndex(0), {{0.3, -1, 0}, {0, 1, 0}}},
                    {FingerIndex(1), {{0.3 - share * limit, 1, 0}, {0, -1, 0}}}};
    plan.goal = ContactsOf(plan.initial);
    const PlanCheck check = CheckPlan(square, plan);
    if (share < 1) {
      ExpectPasses(check, "just inside");
    } else {
      ExpectFails(check, 0, Reason::kNotForceClosure, "just outside");
    }
    ASSERT_TRUE(check.steps[0].required);
    EXPECT_NEAR(check.steps[0].required->upper, std::atan(share * limit / 2), 1e-8);
  }
}

TEST(CheckPlan, LosesForceClosureWhereAFingerIsMovedTooFar) {
  const object::Polyhedron cube = MakeCube();
  // The finger on +x, moved towards a corner. Bisection finds the position at which force closure
  // is lost.
  const auto with_shift = [](double shift) {
    Plan plan = CubePlan();
    plan.steps.clear();
    plan.initial.pop_back();
    plan.initial[0].contact.p = {1, 0.05 + shift, -0.1 - shift};
    plan.goal = ContactsOf(plan.initial);
    return plan;
  };
  double held = 0, lost = 0.9;
  ASSERT_FALSE(CheckPlan(cube, with_shift(lost)).passed());
  while (lost - held > 1e-6) {
    const double middle = (held + lost) / 2;
    (CheckPlan(cube, with_shift(middle)).passed() ? held : lost) = middle;
  }
  EXPECT_GT(held, 0.1);
  ExpectPasses(CheckPlan(cube, with_shift(held)), "just inside");
  ExpectFails(CheckPlan(cube, with_shift(lost)), 0, Reason::kNotForceClosure, "just outside");
}

TEST(CheckPlan, HoldsGraspsToTheNormalsOfPatchesWhereThePlanSaysSo) {
  const object::Polyhedron cube = MakeCube();
  // All four contacts are near edges, where a fingertip also touches the neighbouring face.
  Plan plan = CubePlan();
  plan.steps.clear();
  plan.initial.resize(4);
  plan.initial[0].contact.p = {1, 0.95, 0};
  plan.initial[1].contact.p = {-1, 0.95, 0};
  plan.initial[2].contact.p = {0, 0.95, 1};
  plan.initial[3].contact.p = {0, 0.95, -1};
  plan.goal = ContactsOf(plan.initial);
  ExpectPasses(CheckPlan(cube, plan), "as the faces are");
  plan.patch_radius = 0.04;
  ExpectPasses(CheckPlan(cube, plan), "patches that lie on the faces");
  plan.patch_radius = 0.5;
  const PlanCheck check = CheckPlan(cube, plan);
  ExpectFails(check, 0, Reason::kNotForceClosure, "patches across the edge");
  EXPECT_NE(check.steps[0].detail.find("mean normals within"), std::string::npos);
  EXPECT_FALSE(check.steps[0].force_closure);
}

TEST(CheckPlan, ASwitchNeedsWhatTheGraspsBeforeAndAfterItNeed) {
  const object::Polygon square = MakeSquare();
  const FingerGrasp apart = {{FingerIndex(0), {{0.3, -1, 0}, {0, 1, 0}}},
                             {FingerIndex(1), {{-0.3, 1, 0}, {0, -1, 0}}}};
  const FingerGrasp opposite = {{FingerIndex(2), {{1, 0, 0}, {-1, 0, 0}}},
                                {FingerIndex(3), {{-1, 0, 0}, {1, 0, 0}}}};
  Plan plan = EmptyPlan(2, 4, 20);
  plan.initial = apart;
  plan.steps = {Switch{opposite, {FingerIndex(0), FingerIndex(1)}},
                Switch{apart, {FingerIndex(2), FingerIndex(3)}}};
  plan.goal = ContactsOf(apart);
  const PlanCheck check = CheckPlan(square, plan);
  ExpectPasses(check, "to and fro");
  for (const StepCheck& step : check.steps) {
    ASSERT_TRUE(step.required);
    EXPECT_NEAR(step.required->upper, std::atan(0.3), 1e-8) << step.index;
  }
  plan.initial = opposite;
  plan.steps.clear();
  EXPECT_LT(CheckPlan(square, plan).steps[0].required->upper, 1e-8);
}

TEST(CheckPlan, AGraspThatPassesNeedsNoMoreThanTheFriction) {
  const object::Polygon square = MakeSquare();
  int passed = 0;
  for (int i = 1; i <= 40; ++i) {
    Plan plan = EmptyPlan(2, 4, 40);
    const double apart = 0.02 * i;
    plan.initial = {{FingerIndex(0), {{apart, -1, 0}, {0, 1, 0}}},
                    {FingerIndex(1), {{-apart, 1, 0}, {0, -1, 0}}}};
    plan.goal = ContactsOf(plan.initial);
    // Middle of the bounds, at which the grasp may be force closure without a proof so far.
    const auto bounds = CheckPlan(square, plan).steps[0].required;
    ASSERT_TRUE(bounds);
    plan.friction_angle = bounds->lower + (bounds->upper - bounds->lower) / 2;
    const StepCheck hold = CheckPlan(square, plan).steps[0];
    if (hold.reason != Reason::kNone) continue;
    ++passed;
    ASSERT_TRUE(hold.required);
    EXPECT_LE(hold.required->lower, hold.required->upper);
    EXPECT_LE(hold.required->upper, plan.friction_angle);
  }
  EXPECT_GE(passed, 5);
}

/// A strip of length 1, so thin that fingers at opposite corners require a right angle minus 8e-7
/// rad. Required friction angles are searched up to 1e-6 below a right angle.
struct Strip {
  static constexpr double kHeight = 8e-7;
  object::Polygon polygon =
      object::Polygon::FromRings({{{0, 0}, {1, 0}, {1, kHeight}, {0, kHeight}}}, "strip");

  /// Return a finger below and one above, at this distance along the strip.
  static FingerGrasp Held(double apart) {
    return {{FingerIndex(0), {{0.5 - apart / 2, 0, 0}, {0, 1, 0}}},
            {FingerIndex(1), {{0.5 + apart / 2, kHeight, 0}, {0, -1, 0}}}};
  }
  static Plan HoldPlan(double apart) {
    Plan plan = EmptyPlan(2, 4, 20);
    plan.friction_angle = Radians(90) - kHeight / 2;
    plan.initial = Held(apart);
    plan.goal = ContactsOf(plan.initial);
    return plan;
  }
};

TEST(CheckPlan, WhatHoldsAtNoHalfAngleThatIsLookedForIsNotProved) {
  const Strip strip;
  ExpectPasses(CheckPlan(strip.polygon, Strip::HoldPlan(0.5)), "1.6e-6 rad to a right angle");
  ExpectFails(CheckPlan(strip.polygon, Strip::HoldPlan(1)), 0, Reason::kNotProved, "8e-7 rad");
  // The same during a motion from a grasp that passes to such a grasp.
  Plan plan = Strip::HoldPlan(0.5);
  plan.steps = {Align{{Strip::Held(0.5), Strip::Held(0.6), Strip::Held(0.5)}}};
  ExpectPasses(CheckPlan(strip.polygon, plan), "1.3e-6 rad on the way");
  plan.steps = {Align{{Strip::Held(0.5), Strip::Held(1), Strip::Held(0.5)}}};
  const PlanCheck check = CheckPlan(strip.polygon, plan);
  ExpectFails(check, 1, Reason::kNotProved, "8e-7 rad on the way");
  EXPECT_FALSE(check.steps[1].force_closure);
  EXPECT_FALSE(check.steps[1].required);
}

TEST(CheckPlan, FailsWhereFrictionIsBelowWhatThePlanRequires) {
  const object::Polyhedron cube = MakeCube();
  const Plan plan = CubePlan();
  const PlanCheck check = CheckPlan(cube, plan);
  int checked = 0;
  for (const StepCheck& step : check.steps) {
    ASSERT_TRUE(step.required);
    EXPECT_LE(step.required->lower, step.required->upper);
    CheckOptions options;
    options.friction_angle = step.required->upper + 1e-6;
    EXPECT_TRUE(CheckPlan(cube, plan, options).steps[step.index].force_closure ||
                CheckPlan(cube, plan, options).steps[step.index].skipped);
    options.friction_angle = step.required->lower - 1e-6;
    EXPECT_FALSE(CheckPlan(cube, plan, options).passed());
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

}  // namespace check_force_closure_test
}  // namespace regrasp::plan
