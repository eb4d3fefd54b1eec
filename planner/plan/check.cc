#include "planner/plan/check.h"

#include <algorithm>

#include "planner/base/error.h"
#include "planner/plan/check_step.h"
#include "planner/plan/locate.h"
#include "planner/plan/same_grasp.h"

namespace regrasp {

namespace {

bool Passed(const StepCheck& check) { return !check.skipped && check.reason == Reason::kNone; }

void Fault(StepCheck& check, Reason reason, const std::string& detail) {
  // These reasons are the last of the order: they never hide another.
  if (check.reason != Reason::kNone) return;
  check.reason = reason;
  check.detail = detail;
}

StepCheck CheckStep(const CheckContext& context, const FingerGrasp& before, const Step& step) {
  if (const auto* finger_switch = std::get_if<Switch>(&step)) {
    return CheckSwitch(context, before, *finger_switch);
  }
  return CheckAlign(context, before, std::get<Align>(step));
}

void CheckStart(const CheckContext& context, const CheckOptions& options, StepCheck& hold) {
  if (options.start == nullptr) return;
  if (!AreSameGrasp(ContactsOf(context.plan.initial), *options.start, context.tolerance())) {
    Fault(hold, Reason::kStartDiffers, "the initial grasp is not the given start grasp");
  }
}

void CheckGoal(const CheckContext& context, const CheckOptions& options, const FingerGrasp& last,
               StepCheck& check) {
  if (!AreSameGrasp(ContactsOf(last), context.plan.goal, context.tolerance())) {
    Fault(check, Reason::kGoalNotReached, "the last contacts are not those of the plan's goal");
  }
  if (options.goal != nullptr &&
      !AreSameGrasp(context.plan.goal, *options.goal, context.tolerance())) {
    Fault(check, Reason::kGoalNotReached, "the plan's goal is not the given goal grasp");
  }
}

StepCheck Skipped(int index, const char* kind) {
  StepCheck check;
  check.index = index;
  check.kind = kind;
  check.skipped = true;
  return check;
}

}  // namespace

bool PlanCheck::passed() const { return !steps.empty() && std::ranges::all_of(steps, Passed); }

PlanCheck CheckPlan(const Object& object, const Plan& plan, const CheckOptions& options) {
  if (plan.dimension != object.dimension()) {
    throw InputError("plan: /object/dimension: is " + std::to_string(plan.dimension) +
                     ", but the object has dimension " + std::to_string(object.dimension()));
  }
  PlanCheck result;
  result.located = LocatePlan(object, plan);
  const CheckContext context{object, result.located, options.half_angle.value_or(plan.half_angle)};
  result.steps.push_back(CheckHold(context));
  CheckStart(context, options, result.steps.back());
  FingerGrasp holding = context.plan.initial;
  for (const Step& step : context.plan.steps) {
    const int index = static_cast<int>(result.steps.size());
    if (!Passed(result.steps.back())) {
      result.steps.push_back(Skipped(index, StepKind(step)));
      continue;
    }
    result.steps.push_back(CheckStep(context, holding, step));
    result.steps.back().index = index;
    holding = GraspAfter(holding, step);
  }
  if (Passed(result.steps.back())) CheckGoal(context, options, holding, result.steps.back());
  return result;
}

}  // namespace regrasp
