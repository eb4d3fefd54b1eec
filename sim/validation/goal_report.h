#pragma once

#include <string>
#include <vector>

#include "planner/plan/plan.h"

namespace regrasp::validation {

struct Report;
enum class Verdict;

/// Result of a goal that a plan for a hand marks.
struct GoalReport {
  std::string name;            ///< empty for the only goal of a plan
  plan::EntryIndex step;       ///< step after which the object must be in the goal set
  plan::GoalDistance off;      ///< planned pose relative to the middle of the goal set
  plan::GoalDistance allowed;  ///< tolerances of the goal; a length of 0 for a facing goal
  bool is_facing = false;
  Verdict verdict;  ///< skipped if the step is not reached
};

/// Evaluate the goals of a plan by its planned poses and the verdicts of the steps.
/// @param plan  plan for a hand.
[[nodiscard]] std::vector<GoalReport> EvaluateGoals(const plan::Plan& plan, const Report& report);

}  // namespace regrasp::validation
