#include "sim/validation/goal_report.h"

#include <limits>

#include "sim/validation/validation_report.h"

namespace regrasp::validation {

namespace {

plan::GoalDistance TolerancesOf(const plan::GoalSet& set) {
  if (const plan::FacingGoal* goal = set.facing()) return {0, goal->tolerance};
  return {set.pose()->tolerance.length, set.pose()->tolerance.angle};
}

/// Return the worst verdict of the steps up to and including one.
Verdict VerdictUpTo(plan::EntryIndex last, const Report& report) {
  for (plan::EntryIndex entry{0}; entry <= last; ++entry) {
    const Verdict verdict = report.steps[entry].verdict();
    if (verdict == Verdict::kPass) continue;
    return entry == last ? verdict : Verdict::kSkipped;
  }
  return Verdict::kPass;
}

}  // namespace

std::vector<GoalReport> EvaluateGoals(const plan::Plan& plan, const Report& report) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  std::vector<GoalReport> goals;
  plan::HandState state = plan.hand->initial;
  int step = 0;
  for (const plan::GoalMark& mark : plan.hand->goals) {
    for (; step < mark.step; ++step) state = plan::StateAfter(state, plan.steps[step]);
    const plan::EntryIndex entry(mark.step);
    goals.push_back({mark.name, entry, mark.set.Shrunk(kAll, kAll).Distance(state.pose),
                     TolerancesOf(mark.set), mark.set.facing() != nullptr,
                     VerdictUpTo(entry, report)});
  }
  return goals;
}

}  // namespace regrasp::validation
