// One object in one hand, from the task to the row.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bench/inhand/judge.h"
#include "bench/inhand/plan_task.h"
#include "bench/inhand/run.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/plan_io.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::bench {
namespace score_test {

using testing::HasSubstr;

/// Time limit that a slow machine does not reach, s.
constexpr double kNoLimit_s = 1e6;

kinematics::HandFile Ring4() {
  return kinematics::ReadHandFile(ProjectPath("models/hands/ring4.json"));
}

Task TurnOf(const std::string& body, char axis, double degrees) {
  Task task;
  task.name = "turn/" + body + "/" + axis + std::to_string(std::lround(degrees));
  task.group = "turn";
  task.body = body;
  task.turn = {Eigen::Vector3d::Unit(axis - 'x'), Radians(degrees)};
  return task;
}

/// Plan of a cube of 50 mm that ring4 rotates by 90° about z, made once for all tests.
struct Planned {
  kinematics::HandFile hand = Ring4();
  std::vector<HandBody> bodies = TenBodies(ProjectPath("models"));
  const HandBody& cube = BodyNamed(bodies, "cube-50");
  Task task = TurnOf("cube-50", 'z', 90);
  PlannedTask planned = PlanTask(hand, cube, task, std::nullopt, kNoLimit_s);
};

const Planned& ThePlan() {
  static const Planned planned;
  return planned;
}

/// Return the error message for a plan of another task; empty if it is accepted.
std::string Refusal(const Task& task, const HandBody& body, const plan::Plan& plan) {
  try {
    CheckIsFor(task, body, ThePlan().hand, plan, "plan.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Scoreboard, PassesThePlannersOwnPlan) {
  const Planned& given = ThePlan();
  ASSERT_TRUE(given.planned.plan) << given.planned.message;
  EXPECT_EQ(Refusal(given.task, given.cube, *given.planned.plan), "");
  const Verdict verdict = Judge(given.task, given.cube, given.hand, *given.planned.plan);
  EXPECT_FALSE(verdict.fault) << verdict.fault->detail;
  ASSERT_TRUE(verdict.error);
  EXPECT_LT(verdict.error->metres, 1e-3);
  EXPECT_LT(verdict.error->radians, Radians(2));
}

TEST(Scoreboard, RefusesAPlanOfAnotherTask) {
  const Planned& given = ThePlan();
  const plan::Plan& plan = *given.planned.plan;
  const auto refusal = [&](const Task& task) { return Refusal(task, given.cube, plan); };
  EXPECT_THAT(refusal(TurnOf("cube-50", 'x', 90)), HasSubstr("not a plan for turn/cube-50/x90"));
  EXPECT_THAT(refusal(TurnOf("cube-50", 'z', 45)), HasSubstr("45 degrees from its goal"));
  // Both goals have the same orientation.
  EXPECT_THAT(refusal(TurnOf("cube-50", 'z', 450)), HasSubstr("turns by 90 degrees, not by 450"));
  Task moved = given.task;
  moved.move_m.x() = 0.2;
  EXPECT_THAT(refusal(moved), HasSubstr("mm from its goal"));
  const HandBody& other = BodyNamed(given.bodies, "mug");
  EXPECT_THAT(Refusal(TurnOf("mug", 'z', 90), other, plan), HasSubstr("/object/sha256"));
  const HandBody& larger = BodyNamed(given.bodies, "cube-60");
  EXPECT_THAT(Refusal(TurnOf("cube-60", 'z', 90), larger, plan), HasSubstr("/object/scale"));
}

TEST(Scoreboard, RefusesAPlanForAnotherHandOrMoreFriction) {
  const Planned& given = ThePlan();
  plan::Plan plan = *given.planned.plan;
  plan.hand->sha256 = "0";
  EXPECT_THAT(Refusal(given.task, given.cube, plan), HasSubstr("/hand/sha256"));
  plan.hand.reset();
  EXPECT_THAT(Refusal(given.task, given.cube, plan), HasSubstr("/hand: the plan is for no hand"));
  plan = *given.planned.plan;
  plan.friction_angle = std::atan(0.9);
  EXPECT_THAT(Refusal(given.task, given.cube, plan), HasSubstr("friction is 0.9, more than 0.8"));
  plan.friction_angle = std::atan(0.801);
  EXPECT_THAT(Refusal(given.task, given.cube, plan), HasSubstr("more than 0.8"));
  plan.friction_angle = std::atan(0.8);
  EXPECT_EQ(Refusal(given.task, given.cube, plan), "");
}

/// If a task has a goal position, the plan must end there.
TEST(Scoreboard, TakesAPlanThatEndsWithinAMillimetreOfItsPlace) {
  const Planned& given = ThePlan();
  const plan::Plan& plan = *given.planned.plan;
  const Eigen::Vector3d centre = given.cube.centre();
  const auto goal = [&](const Eigen::Vector3d& move) {
    Task task = given.task;
    task.move_m = move;
    return Eigen::Vector3d(GoalPose(task, centre, plan.hand->initial.pose) * centre);
  };
  // Offset of the end position of the plan from the goal.
  const Eigen::Vector3d off = EndOf(plan).pose * centre - goal(Eigen::Vector3d::Zero());
  Task task = given.task;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = goal(Eigen::Vector3d::Unit(axis)) - goal(Eigen::Vector3d::Zero());
    task.move_m[axis] = along.dot(off);
  }
  task.move_m.x() += 0.0009;
  EXPECT_EQ(Refusal(task, given.cube, plan), "");
  task.move_m.x() += 0.0002;
  EXPECT_THAT(Refusal(task, given.cube, plan), HasSubstr("1.1 mm from its goal"));
}

TEST(Scoreboard, FailsAPlanThatTheHandCannotFollow) {
  const Planned& given = ThePlan();
  plan::Plan plan = *given.planned.plan;
  plan.hand->initial.joints.front().front() += 1;
  const Verdict verdict = Judge(given.task, given.cube, given.hand, plan);
  ASSERT_TRUE(verdict.fault);
  EXPECT_THAT(verdict.fault->detail, HasSubstr("step 0"));
  EXPECT_FALSE(verdict.error);
}

class ScoreRuns : public FolderTest {};

TEST_F(ScoreRuns, WriteARowAndAPlanAndAreNotRepeated) {
  const Planned& given = ThePlan();
  const std::vector<kinematics::HandFile> hands = {given.hand};
  const ScoreRun run{{{given.task}}, &given.bodies, &hands, kNoLimit_s, folder_ / "plans"};
  int reports = 0;
  const auto report = [&](std::string_view) { ++reports; };
  const auto results = folder_ / "rows.jsonl";
  EXPECT_EQ(RunAll(run, results, 1, report), 0);
  EXPECT_EQ(reports, 1);
  const std::vector<Row> rows = ReadRows(results);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows.front().passed) << rows.front().detail;
  EXPECT_EQ(rows.front().task, given.task.name);
  const auto file = folder_ / "plans" / "ring4" / "turn-cube-50-z90.json";
  EXPECT_EQ(rows.front().plan_sha256, Sha256(ReadFile(file)));
  EXPECT_EQ(ReadFile(file), plan::FormatPlan(*given.planned.plan));
  EXPECT_EQ(RunAll(run, results, 1, report), 0);
  EXPECT_EQ(reports, 1);
}

/// Without time the first task has no plan, so the second one has no start.
TEST(RunChain, DoesNotAskForWhatFollowsATaskWithoutAPlan) {
  const Planned& given = ThePlan();
  Task second = TurnOf("cube-50", 'x', 90);
  second.after = given.task.name;
  const std::vector<kinematics::HandFile> hands = {given.hand};
  const Chain chain = {given.task, second};
  const ScoreRun run{{chain}, &given.bodies, &hands, 1e-9, {}};
  const std::vector<Row> rows = RunChain(run, chain, given.hand);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].reason, kNoPlan);
  EXPECT_EQ(rows[1].reason, kNoStart);
  EXPECT_FALSE(rows[0].found || rows[1].found);
}

TEST(PlanTask, BeginsWhereThePlanBeforeItEnds) {
  const Planned& given = ThePlan();
  const TaskStart start = EndOf(*given.planned.plan);
  Task second = TurnOf("cube-50", 'z', 20);
  second.after = given.task.name;
  const PlannedTask planned = PlanTask(given.hand, given.cube, second, start, kNoLimit_s);
  ASSERT_TRUE(planned.plan) << planned.message;
  EXPECT_TRUE(planned.plan->hand->initial.pose.isApprox(start.pose, 1e-12));
  EXPECT_EQ(planned.plan->initial.size(), start.holding.size());
  EXPECT_FALSE(CheckStart(start, *planned.plan));
  TaskStart other = start;
  std::swap(other.holding[0].finger, other.holding[1].finger);
  const auto fault = CheckStart(other, *planned.plan);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->reason, plan::Reason::kStartDiffers);
}

}  // namespace score_test
}  // namespace regrasp::bench
