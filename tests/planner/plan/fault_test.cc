#include <gtest/gtest.h>

#include <functional>

#include "planner/base/number.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace fault_test {

using Eigen::Vector3d;

/// Return the failed step of a changed CubePlan().
StepCheck FailedStep(const std::function<void(Plan&)>& change, const CheckOptions& options = {}) {
  Plan plan = CubePlan();
  change(plan);
  for (StepCheck& step : CheckPlan(MakeCube(), plan, options).steps) {
    if (step.reason != Reason::kNone) return std::move(step);
  }
  ADD_FAILURE() << "the plan passes";
  return {};
}

FingerGrasp& Placed(Plan& plan) { return std::get<Switch>(plan.steps[0]).place; }
std::vector<FingerGrasp>& Waypoints(Plan& plan) { return std::get<Align>(plan.steps[2]).waypoints; }

double Distance(const Fault& fault) { return (fault.found->p - fault.expected.at(0).p).norm(); }

TEST(Fault, OfAPlanThatPassesIsEmpty) {
  for (const StepCheck& step : CheckPlan(MakeCube(), CubePlan()).steps) {
    EXPECT_TRUE(step.fault.fingers.empty());
    EXPECT_FALSE(step.fault.found || step.fault.required || step.fault.disturbance);
    EXPECT_TRUE(step.fault.expected.empty() && step.fault.grasp.empty());
  }
}

TEST(Fault, OffTheSurfaceHasTheNearestPointAndTheTextItsDistance) {
  const StepCheck step = FailedStep([](Plan& plan) {
    Placed(plan)[0].contact.p.y() += 0.125;  // on the face +y of [−1, 1]³
  });
  EXPECT_EQ(step.reason, Reason::kOffSurface);
  EXPECT_EQ(step.fault.fingers, std::vector{FingerIndex(4)});
  EXPECT_NEAR(Distance(step.fault), 0.125, 1e-12);
  EXPECT_NEAR(step.fault.expected[0].p.y(), 1, 1e-12);
  EXPECT_EQ(step.detail, "finger 4 is 6.25 mm off the surface");
}

TEST(Fault, FarOffTheSurfaceHasANearestPointAllTheSame) {
  for (const double far : {1e9, 1e200, 1e308}) {
    const StepCheck step = FailedStep([&](Plan& plan) { plan.initial[0].contact.p.x() = far; });
    EXPECT_EQ(step.reason, Reason::kOffSurface);
    EXPECT_NEAR(step.fault.expected.at(0).p.x(), 1, 1e-6) << far;
    EXPECT_EQ(step.fault.found->p.x(), far);
  }
}

TEST(Fault, OfAWrongNormalHasTheTrueOne) {
  const StepCheck step = FailedStep([](Plan& plan) {
    Vector3d& n = plan.initial[0].contact.n;
    n = Eigen::AngleAxisd(Radians(30), Vector3d::UnitZ()) * n;
  });
  EXPECT_EQ(step.reason, Reason::kWrongNormal);
  const Fault& fault = step.fault;
  EXPECT_NEAR(grasp::AngleBetween(fault.found->n, fault.expected.at(0).n), Radians(30), 1e-9);
  EXPECT_EQ(fault.expected[0].n, CubePlan().initial[0].contact.n);
  EXPECT_LT(Distance(fault), 1e-12);
}

TEST(Fault, NamesTheFingersOfItsReason) {
  struct Case {
    std::function<void(Plan&)> change;
    Reason reason;
    std::vector<FingerIndex> fingers;
  };
  Plan whole = CubePlan();
  const FingerIndex first(0), second(1), last = Waypoints(whole)[1].back().finger;
  const std::vector<Case> cases = {
      {[&](Plan& plan) { Placed(plan)[0].finger = second; }, Reason::kFingerNotFree, {second}},
      {[&](Plan& plan) { plan.initial[1].finger = first; }, Reason::kFingerNotFree, {first}},
      {[&](Plan& plan) { std::get<Switch>(plan.steps[0]).release = {FingerIndex(4)}; },
       Reason::kFingerNotHolding,
       {FingerIndex(4)}},
      {[&](Plan& plan) { Placed(plan)[0].finger = FingerIndex(7); },
       Reason::kTooManyFingers,
       {FingerIndex(7)}},
      {[&](Plan& plan) { plan.initial[1].contact = plan.initial[0].contact; },
       Reason::kCoincidentFingers,
       {first, second}},
      {[&](Plan& plan) { Waypoints(plan)[1].pop_back(); }, Reason::kDiscontinuous, {last}},
  };
  for (const Case& one : cases) {
    const StepCheck step = FailedStep(one.change);
    EXPECT_EQ(ReasonName(step.reason), ReasonName(one.reason));
    EXPECT_EQ(step.fault.fingers, one.fingers) << step.detail;
  }
  EXPECT_EQ(cases.size(), 6u);
}

TEST(Fault, OfAnAlignHasItsWaypointAndWhereTheFingerWas) {
  const StepCheck jumps =
      FailedStep([](Plan& plan) { Waypoints(plan)[0][0].contact.p.y() += 0.25; });
  EXPECT_EQ(jumps.reason, Reason::kDiscontinuous);
  EXPECT_EQ(jumps.fault.waypoint, 0);
  EXPECT_NEAR(Distance(jumps.fault), 0.25, 1e-12);
  const StepCheck leaves = FailedStep([](Plan& plan) {
    Waypoints(plan)[1][2].contact = {{0.2, 0.2, 1}, {0, 0, -1}};
  });
  EXPECT_EQ(leaves.reason, Reason::kLeavesFace);
  EXPECT_EQ(leaves.fault.waypoint, 1);
  EXPECT_EQ(leaves.fault.found->p, Vector3d(0.2, 0.2, 1));
  EXPECT_EQ(leaves.fault.fingers.size(), 1u);
}

TEST(Fault, OfALossOfForceClosureHasTheGraspAndBothAngles) {
  const StepCheck step = FailedStep([](Plan& plan) {
    Waypoints(plan)[1][0].contact.p = {1, 0.95, 0.95};
    Waypoints(plan)[1][1].contact.p = {-1, -0.95, -0.95};
  });
  EXPECT_EQ(step.reason, Reason::kNotForceClosure);
  EXPECT_EQ(step.fault.friction_angle, Radians(30));
  ASSERT_TRUE(step.fault.required.has_value());
  EXPECT_GT(*step.fault.required, Radians(30));
  EXPECT_EQ(step.fault.grasp.size(), 4u);
  EXPECT_TRUE(step.fault.fingers.empty());
}

TEST(Fault, OfStartAndGoalHasTheContactsThatDoNotMatch) {
  const Plan plan = CubePlan();
  grasp::Grasp start = ContactsOf(plan.initial);
  start[1].p.y() += 0.1;
  const StepCheck differs = FailedStep([](Plan&) {}, {.start = &start});
  EXPECT_EQ(differs.reason, Reason::kStartDiffers);
  EXPECT_EQ(differs.fault.fingers, std::vector{plan.initial[1].finger});
  ASSERT_EQ(differs.fault.expected.size(), 1u);
  EXPECT_EQ(differs.fault.expected[0].p, start[1].p);
  const StepCheck goal = FailedStep([](Plan& changed) { changed.goal[0].p.y() += 0.1; });
  EXPECT_EQ(goal.reason, Reason::kGoalNotReached);
  EXPECT_EQ(goal.fault.fingers.size(), 1u);
  EXPECT_NE(goal.detail.find("goal: finger "), std::string::npos) << goal.detail;
  EXPECT_EQ(goal.fault.expected.size(), 1u);
}

TEST(Fault, OfFingersThatAreTooThickHasTheirRadius) {
  const StepCheck step = FailedStep([](Plan&) {}, {.finger_radius = 3});
  EXPECT_EQ(step.reason, Reason::kUnreachable);
  EXPECT_EQ(step.fault.fingers.size(), 2u);
  EXPECT_NEAR(step.fault.finger_radius, 3, 1e-5);
  EXPECT_FALSE(step.fault.grasp.empty());
}

}  // namespace fault_test
}  // namespace regrasp::plan
