#pragma once

#include <vector>

#include "planner/planning/plan_request.h"
#include "planner/planning/plan_result.h"

namespace regrasp::roadmap {

/// Plans a sequence of finger switches on the plain roadmap of contact points and those of start
/// and goal: the fewest switches first, then the largest smallest margin to the required
/// half-angle. Grasps below the quality that is asked for are passed only where there is no other
/// path, and then a warning names the weakest step.
/// @param request  as Planner::Plan has it.
/// @throws NoGrasp, TimeUp
[[nodiscard]] planning::PlanResult SearchContactPoints(const std::vector<grasp::Contact>& contacts,
                                                       const planning::PlanRequest& request);

/// Radians: differences of margin that a plan does not care for (6e-6 degrees).
inline constexpr double kMarginTolerance = 1e-7;

}  // namespace regrasp::roadmap
