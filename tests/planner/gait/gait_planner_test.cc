#include "planner/gait/gait_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/check.h"
#include "planner/planning/in_hand_task.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace gait_planner_test {

using planning::GraspChoice;
using planning::PlanRequest;
using planning::PlanResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A cube of 48 mm in a hand with four fingers.
class GaitPlannerTest : public testing::Test {
 protected:
  planning::InHandTask TaskOf(double degrees) const {
    return {.hand = &hand_,
            .scale = 0.8,
            .robustness = planning::RobustnessLevel::kNone,
            .turn = {Eigen::Vector3d::UnitZ(), Radians(degrees)}};
  }
  PlanRequest Turning(double degrees) const {
    PlanRequest request;
    request.object = file_.object.get();
    request.criteria.friction_angle = std::atan(0.8);
    request.seed = 2;
    AskInHand(TaskOf(degrees), request);
    return request;
  }
  PlanResult Solve(const PlanRequest& request) const { return planning::Solve(planner_, request); }

  const kinematics::HandModel hand_ = kinematics::ReadHand(ProjectPath("models/hands/ring4.json"));
  const object::ObjectFile file_ = ReadModel("cube.obj");
  const GaitPlanner planner_;
};

/// All grasps are force closure; the margin of the result is that of the weakest static grasp.
TEST_F(GaitPlannerTest, PlansPassTheCheckerWithTheReportedMargin) {
  const PlanResult found = Solve(Turning(60));
  ASSERT_TRUE(found.plan) << found.message;
  EXPECT_EQ(found.plan->planner, "gait");
  const plan::PlanCheck check = plan::CheckPlan(*file_.object, *found.plan);
  EXPECT_TRUE(check.passed());
  plan::FingerGrasp grasp = found.plan->initial;
  double required = 0;
  const auto update_required = [&] {
    required = std::max(required, grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(grasp),
                                                                      file_.object->wrench_frame())
                                      ->upper);
  };
  update_required();
  for (const plan::Step& step : found.plan->steps) {
    grasp = plan::GraspAfter(grasp, step);
    update_required();
  }
  EXPECT_NEAR(found.margin, std::atan(0.8) - required, 1e-9);
}

TEST_F(GaitPlannerTest, WithoutAGoalPoseTheObjectKeepsItsStartPose) {
  const PlanResult turned = Solve(Turning(30));
  ASSERT_TRUE(turned.plan) << turned.message;
  PlanRequest request = Turning(30);
  planning::InHandTask stays = TaskOf(0);
  stays.start_pose = turned.plan->hand->initial.pose;
  AskInHand(stays, request);
  const grasp::Grasp grasp = plan::ContactsOf(turned.plan->initial);
  request.start = Given(grasp);
  request.goal = Given(grasp);
  const PlanResult found = Solve(request);
  ASSERT_TRUE(found.plan) << found.message;
  EXPECT_TRUE(found.plan->steps.empty());
  EXPECT_TRUE(found.plan->hand->goal.isApprox(*stays.start_pose));
}

TEST_F(GaitPlannerTest, GivenGraspsAreChecked) {
  const PlanResult turned = Solve(Turning(30));
  ASSERT_TRUE(turned.plan) << turned.message;
  PlanRequest request = Turning(30);
  grasp::Grasp grasp = plan::ContactsOf(turned.plan->initial);
  grasp.pop_back();
  request.start = Given(grasp);
  EXPECT_THAT([&] { (void)Solve(request); },
              ThrowsMessage<InputError>(HasSubstr("planner gait requires 3 to 4 contacts, found " +
                                                  std::to_string(grasp.size()))));
  request.start = Given(plan::ContactsOf(turned.plan->initial));
  request.criteria.friction_angle = Radians(1);
  EXPECT_THAT([&] { (void)Solve(request); },
              ThrowsMessage<InputError>(HasSubstr("given.json: /contacts: not force closure")));
}

TEST_F(GaitPlannerTest, RequiresAHand) {
  PlanRequest request = Turning(30);
  EXPECT_EQ(planning::WhyNotServed(planner_, request), "");
  request.parameters.Edit<GaitParameters>().task.reset();
  EXPECT_THAT(planning::WhyNotServed(planner_, request), HasSubstr("requires a hand (--hand)"));
}

/// A small budget makes the search fail early; a sufficient budget changes nothing.
TEST_F(GaitPlannerTest, StopsAtItsSearchBudget) {
  PlanRequest request = Turning(300);
  request.parameters.Edit<planning::SearchParameters>().budget = 2;
  const PlanResult none = Solve(request);
  EXPECT_FALSE(none.plan);
  EXPECT_EQ(none.status, PlanResult::Status::kNoSequence);
  EXPECT_THAT(none.message, HasSubstr("of 300 degrees"));
  request.parameters.Edit<planning::SearchParameters>().budget.reset();
  EXPECT_TRUE(Solve(request).plan);
}

TEST_F(GaitPlannerTest, ExplainsAFailureAfterTheTimeLimitToo) {
  PlanRequest request = Turning(90);
  request.parameters.Edit<GaitParameters>().task->scale = 20;  // as large as a person
  request.parameters.Edit<planning::SearchParameters>().explain = true;
  // A clock that advances by one second per call.
  auto now = Deadline::Clock::time_point();
  request.deadline = {now + std::chrono::seconds(3),
                      [&] { return now += std::chrono::seconds(1); }};
  EXPECT_THAT(Solve(request).message,
              AllOf(HasSubstr("time-limit ("), testing::Not(HasSubstr("time limit reached")),
                    HasSubstr("no effect: more friction"), HasSubstr("stopped by the time limit")));
}

}  // namespace gait_planner_test
}  // namespace regrasp::gait
