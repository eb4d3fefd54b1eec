#include "planner/planning/random_goal.h"

#include <optional>
#include <utility>

#include "planner/base/deadline.h"

namespace regrasp::planning {

PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan) {
  std::optional<PlanResult> first;
  for (int draw = 1; draw <= kGoalDraws; ++draw) {
    try {
      PlanResult result = plan(draw == kGoalDraws);
      if (result.plan && result.warnings.empty()) return result;
      if (!first) first = std::move(result);
    } catch (const TimeUp&) {
      if (!first) throw;
      break;
    }
  }
  return *first;
}

}  // namespace regrasp::planning
