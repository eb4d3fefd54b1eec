#include "planner/plan/check.h"

#include <algorithm>
#include <cstdint>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/read_object.h"
#include "planner/plan/check_step.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"

namespace regrasp::plan {

namespace {

bool Passed(const StepCheck& check) { return !check.skipped && check.reason == Reason::kNone; }

StepCheck CheckStep(const CheckContext& context, const FingerGrasp& before, const Step& step) {
  if (const auto* finger_switch = std::get_if<Switch>(&step)) {
    return CheckSwitch(context, before, *finger_switch);
  }
  if (const auto* move = std::get_if<Move>(&step)) return CheckMove(context, before, *move);
  return CheckAlign(context, before, std::get<Align>(step));
}

/// Return the fingers whose contacts match no expected contact.
Fault CompareGrasps(const FingerGrasp& held, const grasp::Grasp& expected, double tolerance) {
  Fault fault;
  for (const FingerContact& finger : held) {
    const auto same = [&](const grasp::Contact& contact) {
      return AreSameContact(finger.contact, contact, tolerance);
    };
    if (std::ranges::none_of(expected, same)) fault.fingers.push_back(finger.finger);
  }
  for (const grasp::Contact& contact : expected) {
    const auto same = [&](const FingerContact& finger) {
      return AreSameContact(finger.contact, contact, tolerance);
    };
    if (std::ranges::none_of(held, same)) fault.expected.push_back(contact);
  }
  return fault;
}

/// Return ": finger 2 differs" or ": fingers 0, 2 differ".
std::string ElsewhereText(const Fault& fault) {
  std::string list;
  for (const FingerIndex finger : fault.fingers) {
    list += (list.empty() ? "" : ", ") + std::to_string(finger);
  }
  if (list.empty()) return "";
  return fault.fingers.size() == 1 ? ": finger " + list + " differs"
                                   : ": fingers " + list + " differ";
}

/// Check the initial grasp. start-differs and goal-not-reached are the last reasons of the order.
/// They are checked only if an entry has no other fault, so that grasps are no larger than a hand.
void CheckStart(const CheckContext& context, const CheckOptions& options, StepCheck& hold) {
  if (!Passed(hold) || options.start == nullptr) return;
  if (AreSameGrasp(ContactsOf(context.plan.initial), *options.start, context.tolerance())) return;
  hold.reason = Reason::kStartDiffers;
  hold.fault = CompareGrasps(context.plan.initial, *options.start, context.tolerance());
  hold.detail = "the initial grasp differs from the given start grasp" + ElsewhereText(hold.fault);
}

void CheckGoal(const CheckContext& context, const CheckOptions& options, const FingerGrasp& end,
               StepCheck& last) {
  if (!Passed(last)) return;
  if (!AreSameGrasp(ContactsOf(end), context.plan.goal, context.tolerance())) {
    last.reason = Reason::kGoalNotReached;
    last.fault = CompareGrasps(end, context.plan.goal, context.tolerance());
    last.detail = "the last contacts differ from the plan's goal" + ElsewhereText(last.fault);
  } else if (options.goal != nullptr &&
             !AreSameGrasp(context.plan.goal, *options.goal, context.tolerance())) {
    last.reason = Reason::kGoalNotReached;
    last.fault = CompareGrasps(end, *options.goal, context.tolerance());
    last.detail = "the plan's goal differs from the given goal grasp" + ElsewhereText(last.fault);
  }
}

/// Return the contacts that an entry makes.
std::vector<FingerContact> ContactsMade(const Plan& plan, EntryIndex entry) {
  if (entry == EntryIndex(0)) return plan.initial;
  const Step& step = StepOf(plan, entry);
  if (const auto* finger_switch = std::get_if<Switch>(&step)) return finger_switch->place;
  if (const auto* align = std::get_if<Align>(&step)) return align->waypoints.back();
  return {};
}

/// Check that every contact of a plan at given points is at one of them.
/// No finger may slide, because a sliding finger passes other points.
void CheckPoints(const CheckContext& context, const CheckOptions& options,
                 const FingerGrasp& before, StepCheck& check) {
  if (!Passed(check) || !context.plan.at_given_points || options.given_points == nullptr) return;
  const double most = object::kAtGivenPoint * context.object.diameter() + context.tolerance();
  for (const FingerContact& made : ContactsMade(context.plan, check.index)) {
    const Eigen::Vector3d& p = made.contact.p;
    const Eigen::Vector3d& nearest = object::NearestPoint(*options.given_points, p);
    const FingerContact* held = FindFinger(before, made.finger);
    const bool moves = held != nullptr && (held->contact.p - p).norm() > context.tolerance();
    if ((nearest - p).norm() <= most && !moves) continue;
    check.reason = Reason::kOffPoint;
    check.detail = "finger " + std::to_string(made.finger) +
                   (moves ? " moves along the surface between given points"
                          : " is " + FormatLength((nearest - p).norm() * context.plan.scale) +
                                " from the nearest given point");
    check.fault.fingers = {made.finger};
    check.fault.found = made.contact;
    check.fault.expected = {{nearest, made.contact.n, made.contact.face}};
    return;
  }
}

/// Copy the hand check's fault of an entry that has no other fault.
void TakeHandFault(const CheckOptions& options, StepCheck& check) {
  if (!Passed(check)) return;
  const auto found = std::ranges::find(options.hand_faults, check.index, &HandFault::entry);
  if (found == options.hand_faults.end()) return;
  check.reason = found->reason;
  check.detail = found->detail;
  check.fault = found->fault;
}

StepCheck Skipped(EntryIndex index, const char* kind) {
  StepCheck check;
  check.index = index;
  check.kind = kind;
  check.skipped = true;
  return check;
}

/// Return a budget that is enough for any plan whose sliding steps have a friction margin.
/// They need tens of pieces per motion, and some may need thousands.
motion::ProofBudget BudgetOf(const Plan& plan) {
  constexpr std::int64_t kUnitsOfAPlan = 200'000;
  constexpr std::int64_t kUnitsOfAContact = 250;
  std::int64_t contacts = 0;
  for (const Step& step : plan.steps) {
    const auto* align = std::get_if<Align>(&step);
    const auto* move = std::get_if<Move>(&step);
    const std::vector<FingerGrasp> none;
    for (const FingerGrasp& grasp : align != nullptr  ? align->waypoints
                                    : move != nullptr ? move->contacts
                                                      : none) {
      contacts += static_cast<std::int64_t>(grasp.size());
    }
  }
  return motion::ProofBudget(kUnitsOfAPlan + kUnitsOfAContact * contacts);
}

}  // namespace

EntryIndex WeakestStep(const std::vector<StepCheck>& steps) {
  EntryIndex weakest;
  for (const StepCheck& step : steps) {
    if (step.skipped || !step.required) continue;
    if (!weakest.valid() || step.required->upper > steps[weakest].required->upper) {
      weakest = step.index;
    }
  }
  return weakest;
}

std::string WeakestStepText(const std::vector<StepCheck>& steps, double friction_angle) {
  const EntryIndex weakest = WeakestStep(steps);
  if (!weakest.valid()) return "";
  const auto [needed, available] =
      FormatRequiredDegrees(Degrees(steps[weakest].required->upper), Degrees(friction_angle));
  return "step " + std::to_string(weakest) + " (" + steps[weakest].kind +
         "), which requires a friction angle of " + needed + " of " + available + " degrees";
}

bool PlanCheck::passed() const { return !steps.empty() && std::ranges::all_of(steps, Passed); }

double FarthestFromPoints(const Plan& plan, const std::vector<Eigen::Vector3d>& points) {
  double farthest = 0;
  for (EntryIndex entry{0}; entry <= std::ssize(plan.steps); ++entry) {
    for (const FingerContact& made : ContactsMade(plan, entry)) {
      const Eigen::Vector3d& p = made.contact.p;
      farthest = std::max(farthest, (object::NearestPoint(points, p) - p).norm());
    }
  }
  return farthest;
}

PlanCheck CheckPlan(const object::Object& object, const Plan& plan, const CheckOptions& options) {
  if (plan.dimension != object.dimension()) {
    throw InputError("plan: /object/dimension: expected " + std::to_string(object.dimension()) +
                     " as of the object, found " + std::to_string(plan.dimension));
  }
  const double torsion = options.torsion.value_or(plan.torsion);
  if (torsion != 0 && plan.dimension == 2) {
    throw InputError("plan: /torsion: cannot be used with a planar object");
  }
  PlanCheck result;
  result.projected = ProjectPlan(object, plan);
  SetTorsion(torsion, result.projected);
  // Separate budgets, so that searches for bounds do not use up the budget for decisions.
  motion::ProofBudget decisions = BudgetOf(plan);
  motion::ProofBudget bounds = BudgetOf(plan);
  const double friction_angle = options.friction_angle.value_or(plan.friction_angle);
  StaticGraspClosure static_grasps(object.wrench_frame(), friction_angle);
  std::optional<WeightCarrier> carrier;
  HandState state;
  if (plan.hand) state = plan.hand->initial;
  if (plan.hand && plan.hand->gravity_support && plan.hand->up) {
    carrier.emplace(object.wrench_frame(), friction_angle, *plan.hand->gravity_support,
                    *plan.hand->up);
  }
  const CheckContext context{
      object,
      result.projected,
      friction_angle,
      static_grasps,
      decisions,
      bounds,
      options.finger_radius ? *options.finger_radius : plan.finger_radius.value_or(0),
      options.allow_undecided,
      options.judge_force_closure,
      carrier ? &*carrier : nullptr,
      &state};
  result.steps.push_back(CheckHold(context));
  CheckPoints(context, options, {}, result.steps.back());
  CheckStart(context, options, result.steps.back());
  TakeHandFault(options, result.steps.back());
  FingerGrasp holding = context.plan.initial;
  for (const Step& step : context.plan.steps) {
    const EntryIndex index(static_cast<int>(result.steps.size()));
    if (!Passed(result.steps.back())) {
      result.steps.push_back(Skipped(index, StepKind(step)));
      continue;
    }
    result.steps.push_back(CheckStep(context, holding, step));
    result.steps.back().index = index;
    CheckPoints(context, options, holding, result.steps.back());
    TakeHandFault(options, result.steps.back());
    holding = GraspAfter(holding, step);
    state = StateAfter(state, step);
  }
  CheckGoal(context, options, holding, result.steps.back());
  return result;
}

}  // namespace regrasp::plan
