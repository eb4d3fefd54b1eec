#include "sim/actuation/simulate_execution.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/in_blocks.h"
#include "planner/base/number.h"
#include "planner/gait/gait_planner.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "sim/actuation/condition_replays.h"
#include "sim/scene/scaling.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace simulate_execution_test {

/// Fixture of a cube of 5 cm in a hand of five fingers.
class ExecutionSimulatorTest : public FolderTest {
 protected:
  planning::PlanRequest Turning(double degrees) const {
    planning::PlanRequest request;
    request.object = &cube_;
    request.criteria.friction_angle = std::atan(0.8);
    gait::AskInHand({.hand = &hand_.hand,
                     .scale = 0.8333,
                     .turn = {Eigen::Vector3d::UnitZ(), Radians(degrees)},
                     .simulate = ExecutionSimulator(hand_, cube_)},
                    request);
    return request;
  }

  const kinematics::HandFile hand_ =
      kinematics::ReadHandFile(ProjectPath("models/hands/ring5.json"));
  const object::ObjectFile file_ = ReadModel("cube.obj");
  const object::Polyhedron& cube_ = dynamic_cast<const object::Polyhedron&>(*file_.object);
  const gait::GaitPlanner planner_;
};

TEST_F(ExecutionSimulatorTest, PlansThatThePlannerTriedAreCarriedOutAndWithLittleFrictionNot) {
  const planning::PlanResult found = planning::Solve(planner_, Turning(90));
  ASSERT_TRUE(found.plan) << found.message;
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes.front().find("the plan executes in simulation"), std::string::npos);
  const auto simulate = ExecutionSimulator(hand_, cube_);
  const auto carried = simulate(*found.plan, {});
  ASSERT_TRUE(carried);
  EXPECT_TRUE(carried->is_held);
  EXPECT_TRUE(carried->is_whole);
  EXPECT_EQ(carried->steps, std::ssize(found.plan->steps));
  EXPECT_EQ(carried->reason, plan::Reason::kNone);
  plan::Plan slippery = *found.plan;
  slippery.friction_angle = std::atan(0.05);
  const auto slipped = simulate(slippery, {});
  ASSERT_TRUE(slipped);
  EXPECT_FALSE(slipped->is_whole);
  EXPECT_LT(slipped->steps, std::ssize(found.plan->steps));
  EXPECT_NE(slipped->reason, plan::Reason::kNone);
  EXPECT_NE(slipped->detail, "");
}

/// The clock advances by 1 s at each reading, and there is one reading before every step.
TEST_F(ExecutionSimulatorTest, AtItsDeadlineATrialEndsAndLaterGoesOnFromThere) {
  const planning::PlanResult found = planning::Solve(planner_, Turning(90));
  ASSERT_TRUE(found.plan) << found.message;
  const std::ptrdiff_t steps = std::ssize(found.plan->steps);
  ASSERT_GT(steps, 0);
  const auto simulate = ExecutionSimulator(hand_, cube_);
  Deadline::Clock::time_point now;
  const Deadline after_one_entry(now + std::chrono::seconds(2),
                                 [&now] { return now += std::chrono::seconds(1); });
  const auto cut_short = simulate(*found.plan, after_one_entry);
  ASSERT_TRUE(cut_short);
  EXPECT_TRUE(cut_short->is_cut_short);
  EXPECT_FALSE(cut_short->is_whole);
  EXPECT_TRUE(cut_short->is_held);
  EXPECT_EQ(cut_short->steps, 0);
  const auto over = simulate(*found.plan, after_one_entry);
  ASSERT_TRUE(over);
  EXPECT_TRUE(over->is_cut_short);
  const auto whole = simulate(*found.plan, {});
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->is_whole);
  EXPECT_FALSE(whole->is_cut_short);
  EXPECT_EQ(whole->tolerance_margin,
            ExecutionSimulator(hand_, cube_)(*found.plan, {})->tolerance_margin);
}

TEST_F(ExecutionSimulatorTest, SeveralThreadsGetWhatOneGets) {
  const planning::PlanResult found = planning::Solve(planner_, Turning(90));
  ASSERT_TRUE(found.plan) << found.message;
  plan::Plan slippery = *found.plan;
  slippery.friction_angle = std::atan(0.05);
  const std::vector<const plan::Plan*> plans = {&*found.plan, &slippery, &*found.plan, &slippery};
  const auto together = ExecutionSimulator(hand_, cube_);
  std::vector<std::optional<planning::ExecutionResult>> carried(plans.size());
  InBlocks(plans.size(), 1, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) carried[i] = together(*plans[i], {});
  });
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto alone = ExecutionSimulator(hand_, cube_)(*plans[i], {});
    ASSERT_TRUE(alone && carried[i]);
    EXPECT_EQ(carried[i]->steps, alone->steps);
    EXPECT_EQ(carried[i]->is_whole, alone->is_whole);
    EXPECT_EQ(carried[i]->tolerance_margin, alone->tolerance_margin);
  }
}

TEST_F(ExecutionSimulatorTest, OfAPlanWhoseTrialWasCutShortItIsSaidThatTheTimeWasUp) {
  planning::PlanRequest request = Turning(90);
  request.parameters.Edit<planning::SearchParameters>().budget = 4;
  request.parameters.Edit<gait::GaitParameters>().task->simulate = [](const plan::Plan&,
                                                                      const Deadline&) {
    return std::optional(planning::ExecutionResult{.is_cut_short = true});
  };
  const planning::PlanResult found = planning::Solve(planner_, request);
  ASSERT_TRUE(found.plan) << found.message;
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.front().find("reaches the time limit at the initial grasp"),
            std::string::npos);
  request.parameters.Edit<gait::GaitParameters>().task->robustness =
      planning::RobustnessLevel::kRequired;
  const planning::PlanResult none = planning::Solve(planner_, request);
  EXPECT_FALSE(none.plan);
  EXPECT_NE(none.message.find("reaches the time limit at the initial grasp"), std::string::npos);
  EXPECT_FALSE(none.trial);  // a timeout gives no failure reason
}

TEST_F(ExecutionSimulatorTest, APlanThatDoesNotExecuteIsNoPlanIfRobustnessIsRequired) {
  planning::PlanRequest request = Turning(90);
  request.parameters.Edit<planning::SearchParameters>().budget = 4;
  request.parameters.Edit<gait::GaitParameters>().task->robustness =
      planning::RobustnessLevel::kRequired;
  request.parameters.Edit<gait::GaitParameters>().task->simulate = [](const plan::Plan&,
                                                                      const Deadline&) {
    return std::optional(planning::ExecutionResult{.reason = plan::Reason::kTorqueLimit,
                                                   .detail = "finger 1 is at its limit"});
  };
  const planning::PlanResult none = planning::Solve(planner_, request);
  EXPECT_EQ(none.status, planning::PlanResult::Status::kNoSequence);
  EXPECT_EQ(none.trial, plan::Reason::kTorqueLimit);
  EXPECT_NE(none.message.find("(torque-limit): finger 1 is at its limit"), std::string::npos)
      << none.message;
  request.parameters.Edit<gait::GaitParameters>().task->robustness =
      planning::RobustnessLevel::kPreferred;
  EXPECT_TRUE(planning::Solve(planner_, request).plan);
}

TEST_F(ExecutionSimulatorTest, ThePlanWithTheLargestMarginHasAtLeastThatOfTheFirst) {
  planning::PlanRequest request = Turning(90);
  const auto simulate = ExecutionSimulator(hand_, cube_);
  const auto tolerance_margin = [&] {
    const planning::PlanResult found = planning::Solve(planner_, request);
    EXPECT_TRUE(found.plan) << found.message;
    const auto carried = simulate(*found.plan, {});
    EXPECT_TRUE(carried && carried->is_whole);
    return carried->tolerance_margin;
  };
  const double first = tolerance_margin();
  request.objective = planning::Objective::kMargin;
  const double most = tolerance_margin();
  EXPECT_GT(first, 0);
  EXPECT_GT(most, first);
  EXPECT_LT(most, 1);
}

/// A second route to the same list: the replays of validate --conditions standard.
TEST_F(ExecutionSimulatorTest, RatesAPlanAsTheStandardConditionsDo) {
  const planning::PlanResult found = planning::Solve(planner_, Turning(90));
  ASSERT_TRUE(found.plan) << found.message;
  const auto rate = ExecutionRater(hand_, cube_);
  const auto rating = rate(*found.plan, 100, {});
  ASSERT_TRUE(rating);
  const ConditionSummary summary = RunConditions(
      hand_, cube_, plan::ProjectPlan(cube_, *found.plan), {}, StandardConditions(), 2);
  std::set<std::string> failed;
  for (const ConditionResult& result : summary.results) {
    if (result.applies && !result.passed()) failed.insert(result.condition.name);
  }
  EXPECT_EQ(rating->conditions, summary.applicable());
  EXPECT_EQ(std::set<std::string>(rating->failed.begin(), rating->failed.end()), failed);
  ASSERT_FALSE(failed.empty());
  EXPECT_LT(failed.size(), 10U);
  // Stops at the first failure above the limit, and at the deadline.
  EXPECT_FALSE(rate(*found.plan, static_cast<int>(failed.size()) - 1, {}));
  EXPECT_TRUE(rate(*found.plan, static_cast<int>(failed.size()), {}));
  EXPECT_FALSE(rate(*found.plan, 100, DeadlineAfter(std::chrono::steady_clock::now(), 0)));
  // Negative control: a plan for little friction fails under most conditions.
  plan::Plan slippery = *found.plan;
  slippery.friction_angle = std::atan(0.1);
  EXPECT_GT(rate(slippery, 100, {})->failed.size(), failed.size() + 5);
}

TEST_F(ExecutionSimulatorTest, OfAHandWithoutActuatorsItCanNotTell) {
  std::string model = ReadFile(ProjectPath("models/hands/ring5.xml"));
  const std::string end = "</actuator>";
  const auto begin = model.find("<actuator>");
  ASSERT_NE(begin, std::string::npos);
  model.erase(begin, model.find(end) + end.size() - begin);
  static_cast<void>(Write("ring5.xml", model));
  const std::string path =
      Write("ring5.json", ReadFile(ProjectPath("models/hands/ring5.json"))).string();
  planning::PlanRequest request = Turning(20);
  request.parameters.Edit<gait::GaitParameters>().task->robustness =
      planning::RobustnessLevel::kNone;
  const planning::PlanResult found = planning::Solve(planner_, request);
  ASSERT_TRUE(found.plan) << found.message;
  EXPECT_FALSE(ExecutionSimulator(kinematics::ReadHandFile(path), cube_)(*found.plan, {}));
}

/// At a friction of 0.8 the contacts carry at most √(1 + 0.8²) times their normal forces.
TEST_F(ExecutionSimulatorTest, GraspForcesSupportTheWeightAndAHeavyCubeRequiresTooMuch) {
  const planning::PlanResult found = planning::Solve(planner_, Turning(90));
  ASSERT_TRUE(found.plan) << found.message;
  const int steps = static_cast<int>(found.plan->steps.size());
  const auto measure = GraspForceMeter(hand_, cube_);
  const plan::Plan projected = plan::ProjectPlan(cube_, *found.plan);
  for (const int step : {0, steps}) {
    const auto light = measure(*found.plan, step);
    ASSERT_TRUE(light);
    EXPECT_NEAR(light->weight, 0.05 * 0.05 * 0.05 * 1000 * kGravity, 0.01);
    EXPECT_GE(light->required, light->weight / std::hypot(1, 0.8));
    EXPECT_GT(light->available, light->required);
    HandReplayOptions heavy;
    heavy.mass_kg = 20;
    const auto needed = MeasureGraspForce(hand_, cube_, projected, heavy, step);
    ASSERT_TRUE(needed);
    EXPECT_NEAR(needed->weight, 20 * kGravity, 1e-9);
    EXPECT_LT(needed->available, needed->required);
    // The required force is proportional to the weight.
    EXPECT_NEAR(needed->required / needed->weight, light->required / light->weight, 0.04);
  }
  EXPECT_EQ(measure(*found.plan, steps + 1)->required, measure(*found.plan, steps)->required);
}

}  // namespace simulate_execution_test
}  // namespace regrasp::sim
