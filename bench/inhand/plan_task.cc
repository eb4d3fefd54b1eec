#include "bench/inhand/plan_task.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "bench/processor_clock.h"
#include "bench/random_rests.h"
#include "planner/base/error.h"
#include "planner/certificate/finish_plan.h"
#include "planner/gait/gait_planner.h"
#include "planner/plan/hand_path.h"
#include "planner/planning/solve.h"
#include "sim/actuation/carry_out.h"

namespace regrasp::bench {
namespace {

/// Where the hand's reach is best.
Eigen::Isometry3d HomeOf(const planning::InHandTask& task, const HandBody& body,
                         const criteria::GraspCriteria& criteria) {
  gait::GaitRequest request;
  static_cast<planning::InHandTask&>(request) = task;
  request.solid = &body.solid();
  request.criteria = criteria;
  return RandomRests(request).pose();
}

planning::InHandTask InHandTaskOf(const kinematics::HandFile& hand, const HandBody& body,
                                  const Task& task, const std::optional<TaskStart>& start,
                                  const criteria::GraspCriteria& criteria) {
  planning::InHandTask in_hand{.hand = &hand.hand, .scale = body.scale};
  if (start) in_hand.start_pose = start->pose;
  if (task.is_turn()) {
    in_hand.turn = task.turn;
  } else {
    if (!start) in_hand.start_pose = HomeOf(in_hand, body, criteria);
    in_hand.goal_pose = GoalPose(task, body.centre(), *in_hand.start_pose);
  }
  in_hand.is_carried_out = sim::CarryOutTest(hand, body.solid());
  return in_hand;
}

planning::PlanResult Solve(const kinematics::HandFile& hand, const HandBody& body, const Task& task,
                           const std::optional<TaskStart>& start, const Deadline& deadline) {
  planning::PlanRequest request;
  request.object = &body.solid();
  request.object_name = body.file.file;
  request.criteria.half_angle = std::atan(kFriction);
  request.deadline = deadline;
  gait::AskInHand(InHandTaskOf(hand, body, task, start, request.criteria), request);
  if (start) {
    request.start = {planning::GraspChoice::Kind::kGiven, start->grasp, "the end of " + task.after};
  }
  return planning::Solve(gait::GaitPlanner(), request);
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
  return {state->pose, plan::ContactsOf(holding)};
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
