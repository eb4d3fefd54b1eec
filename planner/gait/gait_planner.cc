#include "planner/gait/gait_planner.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/schedule.h"
#include "planner/planning/rest_summary.h"

namespace regrasp::gait {

namespace {

/// Of what the request may expand, the share of one try: all together take as long as a search that
/// finds nothing; and no fewer.
constexpr std::int64_t kShareOfTry = 20;
constexpr std::int64_t kFewestExpanded = 40;

/// Something that can be otherwise, and by how much, the least first.
struct Relaxation {
  std::string vain;  ///< "more friction"
  std::vector<double> changes;
  /// Changes the request. @returns in words.
  std::function<std::string(double, GaitRequest&)> change;
  std::string helps = {};  ///< the least change that does, in words
};

Relaxation MoreFriction() {
  return {"more friction", {1.1, 1.2, 1.5, 2}, [](double factor, GaitRequest& request) {
            const double before = std::tan(request.criteria.half_angle);
            request.criteria.half_angle = std::atan(factor * before);
            return "a friction of " + FormatShort(factor * before, 3) + " instead of " +
                   FormatShort(before, 3);
          }};
}

/// Contacts that are given grow with the object, poses stay.
Relaxation OtherSize() {
  return {"another size of the object",
          {0.9, 1.1, 0.8, 1.25, 0.65, 1.5, 0.5, 2},
          [](double factor, GaitRequest& request) {
            request.scale *= factor;
            return "the object " + FormatShort(factor, 3) + " times as large (--scale " +
                   FormatShort(request.scale, 4) + ")";
          }};
}

/// The palm tilted about an axis of the hand, `hand` being a place for it.
Relaxation TiltedPalm(kinematics::HandModel& hand) {
  return {"a tilt of the palm",
          {15, -15, 30, -30, 45, -45},
          [&hand](double degrees, GaitRequest& request) {
            hand = *request.hand;
            Eigen::Index least = 0;
            hand.up.cwiseAbs().minCoeff(&least);
            const Eigen::Vector3d axis =
                hand.up.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
            hand.up = Eigen::AngleAxisd(Radians(degrees), axis) * hand.up;
            request.hand = &hand;
            return "the palm tilted by " + FormatShort(std::abs(degrees), 3) +
                   " degrees (\"up\" of the hand file: " + FormatShort(hand.up.x(), 3) + ", " +
                   FormatShort(hand.up.y(), 3) + ", " + FormatShort(hand.up.z(), 3) + ")";
          }};
}

/// One of many tries, which looks at fewer rests. Nothing is asked of motors that don't stop it.
GaitRequest TryOf(const GaitRequest& request, bool with_motors) {
  GaitRequest tried = request;
  if (!with_motors) tried.reserve = Reserve::kNone;
  tried.most_expanded = std::min(request.most_expanded,
                                 std::max(kFewestExpanded, request.most_expanded / kShareOfTry));
  return tried;
}

bool AreMotorsInTheWay(const GaitRequest& request) {
  if (request.reserve != Reserve::kRequired) return false;
  request.progress("trying without the hand's motors");
  return FindGait(TryOf(request, false)).gait.has_value();
}

}  // namespace

std::string ExplainGait(const GaitRequest& request) {
  const bool with_motors = AreMotorsInTheWay(request);
  kinematics::HandModel tilted;
  std::vector<Relaxation> kinds = {MoreFriction(), OtherSize()};
  const bool is_upright = !request.start_pose && !request.goal_pose &&
                          request.start_grasp.empty() && request.goal_grasp.empty();
  if (is_upright) kinds.push_back(TiltedPalm(tilted));
  // The least of each kind first: time is for all alike.
  const auto most =
      std::ranges::max(kinds, {}, [](const Relaxation& kind) { return kind.changes.size(); });
  for (std::size_t i = 0; i < most.changes.size(); ++i) {
    for (Relaxation& kind : kinds) {
      if (i >= kind.changes.size() || !kind.helps.empty()) continue;
      GaitRequest changed = TryOf(request, with_motors);
      const std::string words = kind.change(kind.changes[i], changed);
      changed.progress = [&](std::string_view) { request.progress("trying " + words); };
      if (FindGait(changed).gait) kind.helps = words;
    }
  }
  std::string helps;
  std::string vain;
  for (const Relaxation& kind : kinds) {
    if (!kind.helps.empty()) helps += (helps.empty() ? "" : "; ") + kind.helps;
    if (kind.helps.empty()) vain += (vain.empty() ? "" : ", ") + kind.vain;
  }
  std::string text;
  if (!helps.empty()) text = "would do, each alone: " + helps;
  if (!vain.empty()) {
    if (!text.empty()) text += "; ";
    text += "not found to help: " + vain;
  }
  if (request.deadline.IsOver()) text += " (the time limit ended the tries)";
  return text;
}

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
  request.seeks_most_margin = asked.objective == planning::Objective::kMargin;
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
  if (request.seeks_most_margin && (!request.carry_out || request.reserve == Reserve::kNone)) {
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
