#include "planner/gait/goal_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>

#include "gait_requests.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"

namespace regrasp::gait {
namespace goal_list_test {

using Eigen::Vector3d;

plan::GoalSet Facing(const Vector3d& axis, double degrees) {
  return plan::GoalSet(plan::FacingGoal{axis.normalized(), Ring().up, Radians(degrees)});
}

/// A request without robustness margins, which is fast.
GaitRequest QuickRequest() {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  request.robustness = RobustnessLevel::kNone;
  return request;
}

/// Return the plan of a request for one goal.
plan::Plan PlanFor(const GaitRequest& request) {
  const GaitResult found = FindGait(request);
  EXPECT_TRUE(found.gait) << found.message;
  return found.gait ? PlanOf(*found.gait, request, found.contacts) : plan::Plan();
}

TEST(GoalListTest, AFacingGoalIsReachedAndMarked) {
  GaitRequest request = QuickRequest();
  request.goal = Facing({1, 0, 1}, 30);
  const plan::Plan plan = PlanFor(request);
  ASSERT_TRUE(plan.hand);
  EXPECT_FALSE(plan.steps.empty());
  EXPECT_TRUE(request.goal->Contains(plan.hand->goal));
  ASSERT_EQ(plan.hand->goals.size(), 1u);
  EXPECT_EQ(plan.hand->goals[0].step, std::ssize(plan.steps));
  EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
}

/// The default tolerance leaves no mark, a larger one does.
TEST(GoalListTest, AGoalPoseWithATolerance) {
  GaitRequest request = QuickRequest();
  const plan::Plan any = PlanFor(request);
  request.start_pose = any.hand->initial.pose;
  Eigen::Isometry3d goal = Eigen::Translation3d(0, 0, 0.02) * *request.start_pose;
  request.goal.emplace(goal);
  const plan::Plan exact = PlanFor(request);
  EXPECT_TRUE(exact.hand->goals.empty());
  EXPECT_LT((exact.hand->goal.matrix() - goal.matrix()).norm(), 1e-9);
  request.goal = plan::GoalSet(plan::PoseGoal{goal, plan::PoseTolerance()});
  EXPECT_EQ(plan::FormatPlan(PlanFor(request)), plan::FormatPlan(exact));
  request.goal = plan::GoalSet(plan::PoseGoal{goal, {0.01, Radians(5)}});
  const plan::Plan near = PlanFor(request);
  ASSERT_EQ(near.hand->goals.size(), 1u);
  EXPECT_TRUE(request.goal->Contains(near.hand->goal));
  EXPECT_GT((near.hand->goal.translation() - goal.translation()).norm(), 1e-3);
}

/// Law: a list with one goal gives the plan of that goal.
TEST(GoalListTest, AListWithOneGoalIsThatGoal) {
  GaitRequest request = QuickRequest();
  request.goal = Facing({1, 0, 1}, 30);
  const std::string alone = plan::FormatPlan(PlanFor(request));
  GaitRequest list = QuickRequest();
  list.goals = {{"a", *request.goal}};
  GoalListResult found = FindPlanThroughGoals(list);
  ASSERT_TRUE(found.plan) << found.message;
  EXPECT_EQ(found.plan->hand->goals.at(0).name, "a");
  found.plan->hand->goals[0].name.clear();
  EXPECT_EQ(plan::FormatPlan(*found.plan), alone);
}

TEST(GoalListTest, GoalsAreReachedOneAfterTheOther) {
  GaitRequest request = QuickRequest();
  request.goals = {{"a", Facing({1, 0, 1}, 30)}, {"b", Facing({-1, 0, 1}, 30)}};
  const GoalListResult found = FindPlanThroughGoals(request);
  ASSERT_TRUE(found.plan) << found.message;
  plan::Plan plan = *found.plan;
  ASSERT_EQ(plan.hand->goals.size(), 2u);
  plan::HandState state = plan.hand->initial;
  int step = 0;
  for (const plan::GoalMark& mark : plan.hand->goals) {
    EXPECT_GT(mark.step, step);
    for (; step < mark.step; ++step) {
      const auto paths = plan::PathsOf(plan.steps[step]);
      // Each step begins in the last state before it.
      for (std::size_t finger = 0; finger < state.joints.size(); ++finger) {
        for (std::size_t joint = 0; joint < state.joints[finger].size(); ++joint) {
          const plan::HandPath& first = paths.front()->empty() ? *paths.back() : *paths.front();
          EXPECT_NEAR(first.front().joints[finger][joint], state.joints[finger][joint], 1e-12);
        }
      }
      state = plan::StateAfter(state, plan.steps[step]);
    }
    EXPECT_TRUE(mark.set.Contains(state.pose)) << mark.name;
  }
  EXPECT_EQ(step, std::ssize(plan.steps));
  EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
  plan.object_file = "cube.obj";
  plan.object_sha256 = plan.hand->sha256;
  const plan::Plan read = plan::ParsePlan(plan::FormatPlan(plan), "plan");
  ASSERT_EQ(read.hand->goals.size(), 2u);
  EXPECT_EQ(read.hand->goals[1].name, "b");
  EXPECT_EQ(read.hand->goals[1].step, plan.hand->goals[1].step);
}

TEST(GoalListTest, TheGoalThatIsNotReachedIsReported) {
  GaitRequest request = QuickRequest();
  request.most_expanded = 20;
  Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
  far.translation().z() = 0.4;
  const plan::GoalSet out_of_reach(plan::PoseGoal{far, {0.01, Radians(180)}});
  request.goals = {{"a", Facing({1, 0, 1}, 30)}, {"b", out_of_reach}};
  const GoalListResult found = FindPlanThroughGoals(request);
  EXPECT_FALSE(found.plan);
  EXPECT_THAT(found.message, testing::HasSubstr("goal 2 of 2 (b) is not reached"));
  EXPECT_THAT(found.message, testing::HasSubstr("of the path to its goal"));
}

/// The time is over as soon as the first goal has been reached, or from the beginning.
TEST(GoalListTest, WithoutTimeForASearchTheFirstUnreachedGoalIsReported) {
  GaitRequest request = QuickRequest();
  request.goals = {{"a", Facing({1, 0, 1}, 30)}, {"b", Facing({1, 0, -1}, 30)}};
  Deadline::Clock::time_point now;
  request.deadline = {now + std::chrono::seconds(10), [&] { return now; }};
  request.simulate = [&](const plan::Plan& plan, const Deadline&) {
    now += std::chrono::seconds(20);
    return std::optional(planning::ExecutionResult{
        .is_held = true, .steps = static_cast<int>(plan.steps.size()), .is_whole = true});
  };
  request.robustness = RobustnessLevel::kRequired;
  const GoalListResult second = FindPlanThroughGoals(request);
  EXPECT_FALSE(second.plan);
  EXPECT_THAT(second.message, testing::StartsWith("goal 2 of 2 (b) is not reached"));
  EXPECT_THAT(second.message, testing::EndsWith(": no initial pose was searched"));
  const GoalListResult first = FindPlanThroughGoals(request);
  EXPECT_FALSE(first.plan);
  EXPECT_EQ(first.message, "goal 1 of 2 (a) is not reached: no initial pose was searched");
  request.goals.pop_back();
  EXPECT_EQ(FindPlanThroughGoals(request).message, "no initial pose was searched");
}

/// The part after the first goal is simulated with all steps before it.
TEST(GoalListTest, PlansAreSimulatedFromTheInitialGrasp) {
  GaitRequest request = QuickRequest();
  request.robustness = RobustnessLevel::kRequired;
  request.goals = {{"a", Facing({1, 0, 1}, 40)}, {"b", Facing({0, 0, 1}, 4)}};
  std::vector<std::size_t> steps;
  request.simulate = [&](const plan::Plan& plan, const Deadline&) {
    steps.push_back(plan.steps.size());
    EXPECT_EQ(plan.hand->goals.empty(), false);
    return planning::ExecutionResult{
        .is_held = true, .steps = static_cast<int>(plan.steps.size()), .is_whole = true};
  };
  const GoalListResult found = FindPlanThroughGoals(request);
  ASSERT_TRUE(found.plan) << found.message;
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.back(), found.plan->steps.size());
  EXPECT_GE(static_cast<int>(steps.back()), found.plan->hand->goals[0].step);
}

TEST(GoalListTest, AFailureAfterTheFirstGoalIsCountedFromTheStartOfThePlan) {
  GaitRequest request = QuickRequest();
  request.robustness = RobustnessLevel::kPreferred;
  request.most_expanded = 30;
  request.goals = {{"a", Facing({1, 0, 1}, 40)}, {"b", Facing({0, 0, 1}, 4)}};
  // The first step after the first goal fails.
  request.simulate = [](const plan::Plan& plan, const Deadline&) {
    const bool is_whole = plan.hand->goals.size() == 1;
    return planning::ExecutionResult{
        .is_held = true,
        .steps = plan.hand->goals.front().step,
        .is_whole = is_whole,
        .reason = is_whole ? plan::Reason::kNone : plan::Reason::kSlipped};
  };
  const GoalListResult found = FindPlanThroughGoals(request);
  ASSERT_TRUE(found.plan) << found.message;
  ASSERT_TRUE(found.execution);
  EXPECT_FALSE(found.execution->is_whole);
  ASSERT_GT(found.plan->hand->goals.front().step, 0);
  EXPECT_EQ(found.execution->steps, found.plan->hand->goals.front().step);
}

/// Contacts may differ by rounding, in object units.
bool IsSameGrasp(const plan::FingerGrasp& one, const plan::FingerGrasp& other) {
  constexpr double kRounding = 1e-9;
  return std::ranges::equal(one, other, [](const auto& a, const auto& b) {
    return a.finger == b.finger && (a.contact.p - b.contact.p).norm() < kRounding;
  });
}

/// If the first goal requires no step, the initial grasp may be any one from which the second goal
/// is reached.
TEST(GoalListTest, AnInitialGraspIsSelectedForTheFirstGoalThatRequiresSteps) {
  GaitRequest request = QuickRequest();
  const plan::Plan any = PlanFor(request);
  request.start_pose = any.hand->initial.pose;
  const Vector3d up = request.start_pose->linear().transpose() * Ring().up;
  const plan::GoalSet now(plan::FacingGoal{up, Ring().up, Radians(5)});
  request.goals = {{"now", now}, {"later", Facing({1, 0, 1}, 30)}};
  const GoalListResult found = FindPlanThroughGoals(request);
  ASSERT_TRUE(found.plan) << found.message;
  const plan::Plan& plan = *found.plan;
  ASSERT_EQ(plan.hand->goals.size(), 2u);
  EXPECT_EQ(plan.hand->goals[0].step, 0);
  EXPECT_EQ(plan.hand->goals[1].step, std::ssize(plan.steps));
  EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
  // The plan is that of the second goal alone.
  GaitRequest alone = request;
  alone.goals.erase(alone.goals.begin());
  const GoalListResult second = FindPlanThroughGoals(alone);
  ASSERT_TRUE(second.plan) << second.message;
  EXPECT_TRUE(IsSameGrasp(plan.initial, second.plan->initial));
  EXPECT_EQ(plan.steps.size(), second.plan->steps.size());
  // A given initial grasp is kept.
  StartFrom({any.hand->initial, any.initial}, request);
  request.start_grasp = plan::ContactsOf(any.initial);
  const GoalListResult kept = FindPlanThroughGoals(request);
  ASSERT_TRUE(kept.plan) << kept.message;
  EXPECT_TRUE(IsSameGrasp(kept.plan->initial, any.initial));
}

TEST(GoalListTest, AStartStateIsKept) {
  GaitRequest request = QuickRequest();
  request.turn = {Vector3d::UnitZ(), Radians(30)};
  const plan::Plan first = PlanFor(request);
  const plan::HandEnd end = plan::EndOfPlan(first);
  GaitRequest next = request;
  StartFrom(end, next);
  next.start_grasp = plan::ContactsOf(end.grasp);
  const plan::Plan second = PlanFor(next);
  ASSERT_TRUE(second.hand);
  ASSERT_EQ(second.initial.size(), end.grasp.size());
  for (std::size_t finger = 0; finger < end.state.joints.size(); ++finger) {
    for (std::size_t joint = 0; joint < end.state.joints[finger].size(); ++joint) {
      EXPECT_NEAR(second.hand->initial.joints[finger][joint], end.state.joints[finger][joint],
                  1e-12);
    }
  }
  EXPECT_LT((second.hand->initial.pose.matrix() - end.state.pose.matrix()).norm(), 1e-12);
  next.start_joints.pop_back();
  EXPECT_THROW((void)FindGait(next), std::invalid_argument);
}

}  // namespace goal_list_test
}  // namespace regrasp::gait
