#include "bench/inhand/plan_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/good_poses.h"
#include "bench/processor_clock.h"
#include "planner/base/error.h"
#include "planner/certificate/align_certificate.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/request.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "sim/actuation/simulate_execution.h"

namespace regrasp::bench {
namespace {

/// Places in the hand that a task which moves the centroid may begin in, or have half-way.
constexpr std::size_t kPlaces = 3;

/// Where a task may begin that moves the centroid: where the hand's reach is best, or so that the
/// body is there half-way.
std::vector<Eigen::Isometry3d> StartsOf(const planning::InHandTask& in_hand, const HandBody& body,
                                        const Task& task, const criteria::GraspCriteria& criteria) {
  gait::GaitRequest request;
  static_cast<planning::InHandTask&>(request) = in_hand;
  request.solid = &body.solid();
  request.criteria = criteria;
  Task half = task;
  half.turn.angle /= 2;
  half.move_m /= 2;
  const Eigen::Isometry3d to_half = GoalPose(half, body.centre(), Eigen::Isometry3d::Identity());
  std::vector<Eigen::Isometry3d> starts;
  const std::vector<Eigen::Isometry3d> poses = FindGoodPoses(request).poses;
  for (std::size_t i = 0; i < std::min(kPlaces, poses.size()); ++i) {
    starts.push_back(poses[i]);
    starts.push_back(poses[i] * to_half.inverse());
  }
  return starts;
}

/// All ways to ask for a task, in the order in which they are tried.
std::vector<planning::InHandTask> InHandTasksOf(const kinematics::HandFile& hand,
                                                const HandBody& body, const Task& task,
                                                const std::optional<TaskStart>& start,
                                                const criteria::GraspCriteria& criteria) {
  planning::InHandTask in_hand{
      .hand = &hand.hand, .scale = body.scale, .robustness = planning::RobustnessLevel::kRequired};
  in_hand.simulate = sim::ExecutionSimulator(hand, body.solid());
  if (start) {
    in_hand.start_pose = start->pose;
    for (const plan::FingerContact& held : start->holding) {
      in_hand.start_fingers.push_back(held.finger);
    }
  }
  if (task.is_turn()) {
    in_hand.turn = task.turn;
    return {in_hand};
  }
  std::vector<planning::InHandTask> ways;
  for (const Eigen::Isometry3d& pose :
       start ? std::vector{start->pose} : StartsOf(in_hand, body, task, criteria)) {
    in_hand.start_pose = pose;
    in_hand.goal_pose = GoalPose(task, body.centre(), pose);
    ways.push_back(in_hand);
  }
  return ways;
}

/// Each way has its share of the time that those before it left. The first plan that there is, or
/// why the first way has none; rather where the hand carries none out.
planning::PlanResult Solve(const kinematics::HandFile& hand, const HandBody& body, const Task& task,
                           const std::optional<TaskStart>& start, const Deadline& deadline) {
  planning::PlanRequest request;
  request.object = &body.solid();
  request.object_name = body.file.file;
  request.criteria.half_angle = std::atan(kFriction);
  const auto ways = InHandTasksOf(hand, body, task, start, request.criteria);
  planning::PlanResult found;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    gait::AskInHand(ways[i], request);
    if (start) {
      request.start = {planning::GraspChoice::Kind::kGiven, plan::ContactsOf(start->holding),
                       "the end of " + task.after};
    }
    request.deadline = deadline.After(1.0 / static_cast<double>(ways.size() - i));
    planning::PlanResult result = planning::Solve(gait::GaitPlanner(), request);
    const bool is_done = result.plan || deadline.IsOver();
    if (i == 0 || result.plan || (result.trial && !found.trial)) found = std::move(result);
    if (is_done) break;
  }
  return found;
}

}  // namespace

TaskStart EndOf(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  const plan::HandState* state = &plan.hand->initial;
  for (const plan::Step& step : plan.steps) {
    holding = plan::GraspAfter(holding, step);
    for (const plan::HandPath* path : plan::PathsOf(step)) {
      if (!path->empty()) state = &path->back();
    }
  }
  return {state->pose, std::move(holding)};
}

PlannedTask PlanTask(const kinematics::HandFile& hand, const HandBody& body, const Task& task,
                     const std::optional<TaskStart>& start, double limit_s) {
  PlannedTask planned;
  const double begin = ProcessorSeconds();
  try {
    planning::PlanResult result = Solve(hand, body, task, start, ProcessorDeadline(limit_s));
    planned.seconds = ProcessorSeconds() - begin;
    planned.plan = std::move(result.plan);
    planned.message = std::move(result.message);
    planned.trial = result.trial;
  } catch (const std::runtime_error& error) {  // no place in the hand, or no such start
    planned.seconds = ProcessorSeconds() - begin;
    planned.message = error.what();
  }
  if (planned.plan) {
    // What the checker says of it is for the judge to find out.
    (void)certificate::FinishPlan(
        body.file, {.half_angle = std::atan(kFriction), .scale = body.scale}, *planned.plan);
  }
  return planned;
}

}  // namespace regrasp::bench
