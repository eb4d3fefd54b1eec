#include "planner/gait/gait_planner.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/explain_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/with_reserve.h"
#include "planner/planning/rest_summary.h"

namespace regrasp::gait {
namespace {

using planning::GraspChoice;
using planning::PlanOption;
using planning::PlanRequest;
using planning::PlanResult;

/// No hand that is known has more.
constexpr int kMostFingers = 20;
constexpr int kFewestFingers = 3;

GaitRequest RequestFor(const PlanRequest& asked) {
  GaitRequest request;
  static_cast<planning::InHandTask&>(request) = *asked.in_hand;
  // There are no other objects of three dimensions (WhyNotServed).
  request.solid = &dynamic_cast<const object::Polyhedron&>(*asked.object);
  request.criteria = asked.criteria;
  // Of those that the planner chooses there is none.
  request.start_grasp = asked.start.grasp;
  request.goal_grasp = asked.goal.grasp;
  request.seed = asked.seed;
  request.most_expanded = asked.effort.value_or(kDefaultExpanded);
  request.seeks_most_spare = asked.objective == planning::Objective::kMargin;
  request.deadline = asked.deadline;
  request.jobs = asked.jobs;
  request.progress = asked.progress;
  return request;
}

std::vector<planning::Rest> RestsOf(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  std::vector<planning::Rest> rests = {{plan::ContactsOf(holding), {}}};
  for (const plan::Step& step : plan.steps) {
    holding = plan::GraspAfter(holding, step);
    rests.push_back({plan::ContactsOf(holding), {}});
  }
  return rests;
}

}  // namespace

GaitPlanner::GaitPlanner()
    : Planner({.name = "gait",
               .what = "a hand turns or carries the object",
               .in_space = planning::PlannerScope{kFewestFingers,
                                                  {kFewestFingers, kMostFingers},
                                                  {kFewestFingers, kFewestFingers}},
               .options = {PlanOption::kMargin, PlanOption::kHand, PlanOption::kEffort,
                           PlanOption::kExplain},
               .has_graph = false,
               .needs_hand = true}) {}

PlanResult GaitPlanner::Plan(const PlanRequest& asked) const {
  GaitRequest request = RequestFor(asked);
  if (request.seeks_most_spare && (!request.carry_out || request.reserve == Reserve::kNone)) {
    throw InputError(OptionName(PlanOption::kMargin) +
                     ": goes with plans that the hand tries, and none is tried without reserve");
  }
  const auto time = request.deadline.left();
  const GaitResult found = FindGait(request);
  PlanResult result;
  if (!found.gait) {
    result.status = PlanResult::Status::kNoSequence;
    result.message = found.message;
    if (found.trial) {
      if (!found.trial->is_cut_short) result.trial = found.trial->reason;
      result.message += "; with --reserve preferred there is a plan all the same";
    }
    if (request.deadline.IsOver()) result.message += "; that was when the time was up";
    if (asked.explain) {
      if (time) request.deadline = request.deadline.In(*time);
      result.message += "; " + ExplainGait(request);
    } else {
      result.message +=
          "; help: --explain searches for a friction, an object size and a palm tilt "
          "that help";
    }
    return result;
  }
  result.plan = PlanOf(*found.gait, request, found.contacts);
  if (found.trial && found.trial->is_whole) {
    result.notes.push_back("the hand's own motors carry it out in a simulation, with " +
                           FormatShort(std::floor(100 * found.trial->spare)) +
                           " % of the replay's limits to spare at its closest");
  } else if (found.trial) {
    const bool says = !found.trial->is_cut_short;
    result.warnings.push_back(
        std::string("the hand's own motors do not ") + (says ? "" : "yet ") +
        "carry it out in a simulation: " + FailureText(*found.trial, result.plan->steps.size()) +
        "; validate --hand " + (says ? "shows it" : "says whether they do"));
  }
  const std::vector<planning::Rest> rests = RestsOf(*result.plan);
  const criteria::GraspEvaluator evaluator(*asked.object, asked.criteria, FingersOf(request));
  result.margin = planning::SmallestMargin(rests, evaluator);
  for (std::string& warning : planning::RestWarnings(rests, evaluator)) {
    result.warnings.push_back(std::move(warning));
  }
  return result;
}

void AskInHand(const planning::InHandTask& task, PlanRequest& request) {
  request.in_hand = std::make_shared<planning::InHandTask>(task);
  // A grasp for another one, and no word of the pose: the object stays where it is.
  if (task.turn.angle == 0 && !task.goal_pose) request.in_hand->goal_pose = task.start_pose;
  // What contacts are is not the hand file's to say: soft fingers that are asked for are refused.
  const double torsion = request.hand.torsion;
  request.hand = FingersOf(task);
  request.hand.torsion = torsion;
  for (GraspChoice* choice : {&request.start, &request.goal}) {
    *choice = {GraspChoice::Kind::kAny, {}, {}};
  }
}

}  // namespace regrasp::gait
