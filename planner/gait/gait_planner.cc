#include "planner/gait/gait_planner.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/goal_list.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/request.h"
#include "planner/gait/schedule.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/planning/in_hand_task.h"

namespace regrasp::gait {

namespace {

/// Budget of one probe: fraction of the request's budget, so that all probes together take as long
/// as a failing search, and its minimum.
constexpr std::int64_t kProbeFraction = 20;
constexpr std::int64_t kFewestExpanded = 40;

/// A parameter of the request with its alternative values, smallest change first.
struct Relaxation {
  std::string no_help;  ///< change without effect, for example "more friction"
  std::vector<double> changes;
  /// Changes the request. Returns the change in words.
  std::function<std::string(double, GaitRequest&)> change;
  std::string helps = {};  ///< smallest change that helps, in words
};

Relaxation MoreFriction() {
  return {"more friction", {1.1, 1.2, 1.5, 2}, [](double factor, GaitRequest& request) {
            const double before = std::tan(request.criteria.friction_angle);
            request.criteria.friction_angle = std::atan(factor * before);
            return "a friction of " + FormatShort(factor * before, 3) + " instead of " +
                   FormatShort(before, 3);
          }};
}

/// Given contacts scale with the object; poses do not.
Relaxation OtherSize() {
  return {"another size of the object",
          {0.9, 1.1, 0.8, 1.25, 0.65, 1.5, 0.5, 2},
          [](double factor, GaitRequest& request) {
            request.scale *= factor;
            return "the object " + FormatShort(factor, 3) + " times as large (--scale " +
                   FormatShort(request.scale, 4) + ")";
          }};
}

/// Tilt the palm about an axis of the hand.
/// @param hand  storage for the tilted hand.
Relaxation TiltedPalm(kinematics::HandModel& hand) {
  return {"a tilt of the palm",
          {15, -15, 30, -30, 45, -45},
          [&hand](double degrees, GaitRequest& request) {
            hand = *request.hand;
            Eigen::Index least = 0;
            hand.up.cwiseAbs().minCoeff(&least);
            const Eigen::Vector3d axis =
                hand.up.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
            kinematics::SetUp(Eigen::AngleAxisd(Radians(degrees), axis) * hand.up, hand);
            request.hand = &hand;
            return "the palm tilted by " + FormatShort(std::abs(degrees), 3) +
                   " degrees (\"up\" of the hand file: " + FormatShort(hand.up.x(), 3) + ", " +
                   FormatShort(hand.up.y(), 3) + ", " + FormatShort(hand.up.z(), 3) + ")";
          }};
}

/// Return a probe with a smaller budget. Actuators are ignored unless they limit the request.
GaitRequest ProbeOf(const GaitRequest& request, bool with_actuators) {
  GaitRequest probe = request;
  probe.names_causes = false;
  if (!with_actuators) probe.robustness = RobustnessLevel::kNone;
  probe.most_expanded = std::min(request.most_expanded,
                                 std::max(kFewestExpanded, request.most_expanded / kProbeFraction));
  return probe;
}

bool IsLimitedByActuators(const GaitRequest& request) {
  if (request.robustness != RobustnessLevel::kRequired) return false;
  request.progress("searching without simulation");
  return FindGait(ProbeOf(request, false)).gait.has_value();
}

using planning::GraspChoice;
using planning::PlanRequest;
using planning::PlanResult;

/// No known hand has more fingers.
constexpr int kMostFingers = 20;
constexpr int kFewestFingers = 3;

GaitRequest RequestFor(const PlanRequest& asked) {
  GaitRequest request;
  static_cast<planning::InHandTask&>(request) = asked.parameters.Get<GaitParameters>().task.value();
  // Spatial objects are always polyhedra (WhyNotServed).
  request.solid = &dynamic_cast<const object::Polyhedron&>(*asked.object);
  request.criteria = asked.criteria;
  // Empty if the planner chooses them.
  request.start_grasp = asked.start.grasp;
  request.goal_grasp = asked.goal.grasp;
  request.seed = asked.seed;
  request.most_expanded =
      asked.parameters.Get<planning::SearchParameters>().budget.value_or(kDefaultExpanded);
  request.seeks_most_margin = asked.objective == planning::Objective::kMargin;
  request.names_causes = true;
  request.deadline = asked.deadline;
  request.jobs = asked.jobs;
  request.progress = asked.progress;
  return request;
}

std::vector<planning::StaticGrasp> StaticGraspsOf(const plan::Plan& plan) {
  plan::FingerGrasp grasp = plan.initial;
  std::vector<planning::StaticGrasp> grasps = {{plan::ContactsOf(grasp), {}}};
  for (const plan::Step& step : plan.steps) {
    grasp = plan::GraspAfter(grasp, step);
    grasps.push_back({plan::ContactsOf(grasp), {}});
  }
  return grasps;
}

/// Find a plan for the goal of a request, or for its list of goals.
GoalListResult FindPlanUnderGravity(const GaitRequest& request) {
  if (!request.goals.empty()) return FindPlanThroughGoals(request);
  GaitResult found = FindGait(request);
  GoalListResult result{std::nullopt, std::move(found.execution), std::move(found.message)};
  if (found.gait) result.plan = PlanOf(*found.gait, request, found.contacts);
  return result;
}

/// Let gravity act in another direction: on the hand, and on goals that point up or down.
/// @param hand  becomes the hand of the request.
void TurnGravity(Eigen::Vector3d up, kinematics::HandModel& hand, GaitRequest& request) {
  hand = *request.hand;
  kinematics::SetUp(up, hand);
  request.hand = &hand;
  request.ups.clear();
  if (request.goal) request.goal = request.goal->WithUp(up);
  for (plan::NamedGoal& goal : request.goals) goal.set = goal.set.WithUp(up);
}

/// Find a plan with the first possible one of several directions of gravity.
GoalListResult FindPlan(const GaitRequest& request) {
  if (request.ups.empty()) return FindPlanUnderGravity(request);
  GoalListResult first;
  const std::size_t count = request.ups.size();
  for (std::size_t i = 0; i < count; ++i) {
    kinematics::HandModel hand;
    GaitRequest turned = request;
    TurnGravity(request.ups[i], hand, turned);
    turned.deadline = request.deadline.After(1 / static_cast<double>(count - i));
    turned.progress = [&](std::string_view text) {
      request.progress("direction of gravity " + std::to_string(i + 1) + " of " +
                       std::to_string(count) + ": " + std::string(text));
    };
    GoalListResult found = FindPlanUnderGravity(turned);
    if (found.plan) return found;
    if (i == 0) first = std::move(found);
  }
  first.message +=
      "; " + std::to_string(count - 1) + " other directions of gravity do not yield a plan either";
  return first;
}

/// Example: "goals: a after step 3, b after step 9".
std::string GoalsText(const std::vector<plan::GoalMark>& goals) {
  std::string text;
  for (const plan::GoalMark& goal : goals) {
    text +=
        (text.empty() ? "goals: " : ", ") + goal.name + " after step " + std::to_string(goal.step);
  }
  return text;
}

/// Example: "direction of gravity in the palm frame: (0, 0, -1), that of the hand file".
std::string GravityText(const kinematics::HandModel& hand, const plan::Plan& plan) {
  const Eigen::Vector3d down = -plan.hand->up.value_or(hand.up);
  return "direction of gravity in the palm frame: (" + FormatShort(down.x() + 0.0) + ", " +
         FormatShort(down.y() + 0.0) + ", " + FormatShort(down.z() + 0.0) + ")" +
         (plan.hand->up ? "" : ", that of the hand file");
}

/// Example: "the plan passes 24 of 26 standard conditions and fails under torsion-5mm,
/// joints-1deg".
std::string RatingText(const planning::RobustnessRating& rating) {
  std::string text = "the plan passes " + std::to_string(rating.passed()) + " of " +
                     std::to_string(rating.conditions) + " standard conditions";
  for (const std::string& name : rating.failed) {
    text += (&name == &rating.failed.front() ? " and fails under " : ", ") + name;
  }
  return text;
}

}  // namespace

std::string ExplainGait(const GaitRequest& request) {
  const bool with_actuators = IsLimitedByActuators(request);
  kinematics::HandModel tilted;
  std::vector<Relaxation> relaxations = {MoreFriction(), OtherSize()};
  const bool is_upright = !request.start_pose && !request.goal && request.start_grasp.empty() &&
                          request.goal_grasp.empty();
  if (is_upright) relaxations.push_back(TiltedPalm(tilted));
  // Try the smallest change of every relaxation first, so that all share the time.
  const auto most = std::ranges::max(
      relaxations, {}, [](const Relaxation& relaxation) { return relaxation.changes.size(); });
  for (std::size_t i = 0; i < most.changes.size(); ++i) {
    for (Relaxation& relaxation : relaxations) {
      if (i >= relaxation.changes.size() || !relaxation.helps.empty()) continue;
      GaitRequest changed = ProbeOf(request, with_actuators);
      const std::string words = relaxation.change(relaxation.changes[i], changed);
      changed.progress = [&](std::string_view) { request.progress("trying " + words); };
      if (FindGait(changed).gait) relaxation.helps = words;
    }
  }
  std::string helps;
  std::string no_help;
  for (const Relaxation& relaxation : relaxations) {
    if (!relaxation.helps.empty()) helps += (helps.empty() ? "" : "; ") + relaxation.helps;
    if (relaxation.helps.empty()) no_help += (no_help.empty() ? "" : ", ") + relaxation.no_help;
  }
  std::string text;
  if (!helps.empty()) text = "any one of these changes yields a plan: " + helps;
  if (!no_help.empty()) {
    if (!text.empty()) text += "; ";
    text += "no effect: " + no_help;
  }
  if (request.deadline.IsOver()) text += " (stopped by the time limit)";
  return text;
}

GaitPlanner::GaitPlanner()
    : Planner({.name = "gait",
               .what = "a hand rotates or translates the object",
               .in_space = planning::PlannerScope{kFewestFingers,
                                                  {kFewestFingers, kMostFingers},
                                                  {kFewestFingers, kFewestFingers}},
               .options = {planning::kMarginOption, planning::kHandOption, planning::kBudgetOption,
                           planning::kExplainOption},
               .has_graph = false,
               .needs_hand = true}) {}

PlanResult GaitPlanner::Plan(const PlanRequest& asked) const {
  GaitRequest request = RequestFor(asked);
  kinematics::HandModel turned;
  if (request.ups.size() == 1) TurnGravity(request.ups.front(), turned, request);
  if (request.seeks_most_margin &&
      (!request.simulate || request.robustness == RobustnessLevel::kNone)) {
    throw InputError(std::string(planning::kMarginOption) +
                     ": requires simulated plans, cannot be used with --robustness none");
  }
  const auto time = request.deadline.left();
  const bool explains = asked.parameters.Get<planning::SearchParameters>().explain;
  if (explains && !request.goals.empty()) {
    throw InputError(std::string(planning::kExplainOption) + ": cannot be used with --goals");
  }
  GoalListResult found = FindPlan(request);
  PlanResult result;
  if (!found.plan) {
    result.status = PlanResult::Status::kNoSequence;
    result.message = found.message;
    if (found.execution && !found.execution->is_cut_short) result.trial = found.execution->reason;
    // A search that is given up states its causes, the time limit among them.
    const bool states_limit = result.message.find("time-limit (") != std::string::npos;
    if (request.deadline.IsOver() && !states_limit) result.message += "; time limit reached";
    if (explains) {
      if (time) request.deadline = request.deadline.In(*time);
      result.message += "; " + ExplainGait(request);
    }
    // A message has at most one help part, at its end.
    if (found.execution) {
      result.message += "; help: --robustness preferred writes the best plan anyway";
    } else if (!explains && request.goals.empty()) {
      result.message +=
          "; help: --explain searches for a friction, an object size and a palm tilt that help";
    }
    return result;
  }
  result.plan = std::move(found.plan);
  if (found.execution && found.execution->is_whole) {
    result.notes.push_back("the plan executes in simulation with a tolerance margin of " +
                           FormatShort(std::floor(100 * found.execution->tolerance_margin)) +
                           " % of the replay's limits");
    if (found.execution->rating) {
      result.notes.push_back(RatingText(*found.execution->rating));
    } else if (request.seeks_most_margin && request.rate) {
      result.warnings.push_back(
          "time limit reached before a plan was simulated under the standard conditions: the plan "
          "is the first one that executes");
    }
  } else if (found.execution) {
    const bool is_failure = !found.execution->is_cut_short;
    result.warnings.push_back(
        std::string(is_failure ? "the plan does not execute in simulation: it "
                               : "the plan is not completely simulated: the simulation ") +
        FailureText(*found.execution, result.plan->steps.size()) + "; help: validate --hand " +
        (is_failure ? "shows the failure" : "completes the simulation"));
  }
  if (!request.goals.empty()) result.notes.push_back(GoalsText(result.plan->hand->goals));
  if (!request.ups.empty()) result.notes.push_back(GravityText(*request.hand, *result.plan));
  const std::vector<planning::StaticGrasp> grasps = StaticGraspsOf(*result.plan);
  const criteria::GraspEvaluator evaluator(*asked.object, asked.criteria, FingersOf(request));
  result.margin = planning::SmallestMargin(grasps, evaluator);
  for (std::string& warning : planning::GraspWarnings(grasps, evaluator)) {
    result.warnings.push_back(std::move(warning));
  }
  return result;
}

void AskInHand(const planning::InHandTask& task, PlanRequest& request) {
  planning::InHandTask& own = request.parameters.Edit<GaitParameters>().task.emplace(task);
  // For a change of grasp without a given goal pose, the object keeps its pose.
  const bool moves = task.turn.angle != 0 || task.goal || !task.goals.empty();
  if (!moves && task.start_pose) own.goal.emplace(*task.start_pose);
  // The hand file does not define the contact model; a request for soft fingers must still be
  // rejected.
  const double torsion = request.hand.torsion;
  request.hand = FingersOf(task);
  request.hand.torsion = torsion;
  for (GraspChoice* choice : {&request.start, &request.goal}) {
    *choice = {GraspChoice::Kind::kAny, {}, {}};
  }
}

}  // namespace regrasp::gait
