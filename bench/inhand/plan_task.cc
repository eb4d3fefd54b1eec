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

/// Number of initial poses of a task that moves the centroid.
constexpr std::size_t kStarts = 6;

/// Return initial poses of a task that moves the centroid: those with the best reach throughout its
/// motion.
std::vector<Eigen::Isometry3d> StartsOf(const planning::InHandTask& in_hand, const HandBody& body,
                                        const Task& task, const criteria::GraspCriteria& criteria) {
  gait::GaitRequest request;
  static_cast<planning::InHandTask&>(request) = in_hand;
  request.solid = &body.solid();
  request.criteria = criteria;
  std::vector<Eigen::Isometry3d> starts = FindGoodPoses(request, task.turn, task.move_m).poses;
  starts.resize(std::min(kStarts, starts.size()));
  return starts;
}

/// Return all formulations of a task, in the order of their use.
std::vector<planning::InHandTask> InHandTasksOf(const kinematics::HandFile& hand,
                                                const HandBody& body, const Task& task,
                                                const std::optional<TaskStart>& start,
                                                const criteria::GraspCriteria& criteria) {
  planning::InHandTask in_hand{
      .hand = &hand.hand, .scale = body.scale, .robustness = planning::RobustnessLevel::kRequired};
  in_hand.simulate = sim::ExecutionSimulator(
      hand, body.solid(), sim::PlanningConditions(sim::PlanningRobustness::kNominal));
  in_hand.measure_force = sim::GraspForceMeter(hand, body.solid());
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
    in_hand.goal.emplace(GoalPose(task, body.centre(), pose));
    ways.push_back(in_hand);
  }
  return ways;
}

/// Try each formulation with an equal share of the remaining time. Return the first plan found, or
/// the result of the first formulation. A result whose plans fail in simulation takes precedence
/// over other failures.
planning::PlanResult Solve(const kinematics::HandFile& hand, const HandBody& body, const Task& task,
                           const std::optional<TaskStart>& start, const Deadline& deadline,
                           const HoldingWay& holding) {
  planning::PlanRequest request;
  request.object = &body.solid();
  request.object_name = body.file.file;
  request.criteria.friction_angle = std::atan(kFriction);
  auto ways = InHandTasksOf(hand, body, task, start, request.criteria);
  for (planning::InHandTask& way : ways) {
    way.gravity_support = holding.gravity_support;
    way.rolls = holding.rolls;
  }
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
                     const std::optional<TaskStart>& start, double limit_s,
                     const HoldingWay& holding) {
  PlannedTask planned;
  const double begin = ProcessorSeconds();
  try {
    planning::PlanResult result =
        Solve(hand, body, task, start, ProcessorDeadline(limit_s), holding);
    planned.seconds = ProcessorSeconds() - begin;
    planned.plan = std::move(result.plan);
    planned.message = std::move(result.message);
    planned.trial = result.trial;
  } catch (const std::runtime_error& error) {  // no pose in the hand, or no such start
    planned.seconds = ProcessorSeconds() - begin;
    planned.message = error.what();
  }
  if (planned.plan) {
    // The evaluation reports the result of the checker.
    (void)certificate::FinishPlan(
        body.file, {.friction_angle = std::atan(kFriction), .scale = body.scale}, *planned.plan);
  }
  return planned;
}

}  // namespace regrasp::bench
