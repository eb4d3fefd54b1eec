#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "planner/base/number.h"
#include "planner/plan/check.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace check_laws_test {

/// Return the cube's plan and changed versions that fail, so that laws are tested for both
/// verdicts.
std::vector<Plan> Plans() {
  std::vector<Plan> plans(6, CubePlan());
  plans[1].initial[2].contact.p.z() *= 1.01;
  std::get<Switch>(plans[2].steps[1]).release = {FingerIndex(0)};
  std::get<Align>(plans[3].steps[2]).waypoints[1][0].contact.p = {1, 0.95, 0.95};
  std::get<Align>(plans[3].steps[2]).waypoints[1][1].contact.p = {-1, -0.95, -0.95};
  plans[4].friction_angle = Radians(1);
  plans[5].goal.pop_back();
  return plans;
}

void ForEachFinger(Plan& plan, const std::function<void(FingerIndex&)>& change) {
  for (FingerContact& held : plan.initial) change(held.finger);
  for (Step& step : plan.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      for (FingerContact& held : finger_switch->place) change(held.finger);
      for (FingerIndex& finger : finger_switch->release) change(finger);
    } else {
      for (FingerGrasp& waypoint : std::get<Align>(step).waypoints) {
        for (FingerContact& held : waypoint) change(held.finger);
      }
    }
  }
}

void ForEachContact(Plan& plan, const std::function<void(grasp::Contact&)>& change) {
  for (FingerContact& held : plan.initial) change(held.contact);
  for (Step& step : plan.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      for (FingerContact& held : finger_switch->place) change(held.contact);
    } else {
      for (FingerGrasp& waypoint : std::get<Align>(step).waypoints) {
        for (FingerContact& held : waypoint) change(held.contact);
      }
    }
  }
  for (grasp::Contact& contact : plan.goal) change(contact);
}

void ExpectSameVerdict(const PlanCheck& a, const PlanCheck& b) {
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    EXPECT_EQ(ReasonName(a.steps[k].reason), ReasonName(b.steps[k].reason)) << k;
    EXPECT_EQ(a.steps[k].skipped, b.steps[k].skipped) << k;
    EXPECT_EQ(a.steps[k].force_closure, b.steps[k].force_closure) << k;
    ASSERT_EQ(a.steps[k].required.has_value(), b.steps[k].required.has_value()) << k;
    if (!a.steps[k].required) continue;
    // The bounds of a sliding step have an accuracy of 1e-4 rad, because rounding may bisect other
    // intervals.
    EXPECT_NEAR(a.steps[k].required->upper, b.steps[k].required->upper, 1e-4) << k;
  }
}

TEST(CheckLaws, TheNumberingOfFingersDoesNotMatter) {
  const object::Polyhedron cube = MakeCube();
  int passed = 0, failed = 0;
  for (const Plan& plan : Plans()) {
    const PlanCheck expected = CheckPlan(cube, plan);
    Plan renumbered = plan;
    ForEachFinger(renumbered,
                  [](FingerIndex& finger) { finger = FingerIndex((2 * finger + 1) % 5); });
    ExpectSameVerdict(CheckPlan(cube, renumbered), expected);
    ++(expected.passed() ? passed : failed);
  }
  EXPECT_EQ(passed, 1);
  EXPECT_EQ(failed, 5);
}

TEST(CheckLaws, TheOrderOfContactsDoesNotMatter) {
  const object::Polyhedron cube = MakeCube();
  for (const Plan& plan : Plans()) {
    Plan reordered = plan;
    std::ranges::reverse(reordered.initial);
    std::ranges::reverse(reordered.goal);
    for (Step& step : reordered.steps) {
      auto* align = std::get_if<Align>(&step);
      if (align == nullptr) continue;
      for (FingerGrasp& waypoint : align->waypoints)
        std::ranges::rotate(waypoint, waypoint.begin() + 1);
    }
    ExpectSameVerdict(CheckPlan(cube, reordered), CheckPlan(cube, plan));
  }
}

TEST(CheckLaws, MovingAndScalingObjectAndPlanDoesNotMatter) {
  const object::Polyhedron cube = MakeCube();
  const double size = 0.037;
  const Eigen::Vector3d offset(0.3, -0.1, 0.2);
  const object::Polyhedron moved = MakeCube(size, offset);
  for (const Plan& plan : Plans()) {
    Plan changed = plan;
    ForEachContact(changed,
                   [&](grasp::Contact& contact) { contact.p = size * contact.p + offset; });
    ExpectSameVerdict(CheckPlan(moved, changed), CheckPlan(cube, plan));
  }
}

TEST(CheckLaws, TurningThePlanOnTheCubeDoesNotMatter) {
  const object::Polyhedron cube = MakeCube();
  Eigen::Matrix3d turn;
  turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  for (const Plan& plan : Plans()) {
    Plan turned = plan;
    ForEachContact(turned, [&](grasp::Contact& contact) {
      contact.p = turn * contact.p;
      contact.n = turn * contact.n;
    });
    ExpectSameVerdict(CheckPlan(cube, turned), CheckPlan(cube, plan));
  }
}

TEST(CheckLaws, MoreFrictionNeverTurnsPassIntoFail) {
  const object::Polyhedron cube = MakeCube();
  int changes = 0;
  for (const Plan& plan : Plans()) {
    bool passed = false;
    for (int degrees = 2; degrees < 90; degrees += 4) {
      CheckOptions options;
      options.friction_angle = Radians(degrees);
      const bool passes = CheckPlan(cube, plan, options).passed();
      EXPECT_FALSE(passed && !passes) << degrees;
      if (passes != passed) ++changes;
      passed = passes;
    }
  }
  EXPECT_GT(changes, 0);
}

}  // namespace check_laws_test
}  // namespace regrasp::plan
