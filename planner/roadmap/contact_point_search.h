#pragma once

#include <vector>

#include "planner/planning/plan_request.h"
#include "planner/planning/plan_result.h"

namespace regrasp::roadmap {

/// Plans a sequence of finger switches on the plain roadmap of contact points and those of start
/// and goal: the fewest switches first, then the largest smallest margin to the required
/// half-angle. Grasps below the quality that is asked for are passed only where there is no other
/// way, and then a warning names the weakest step.
/// @param request  as Planner::Plan has it.
/// @throws NoGrasp, TimeUp
[[nodiscard]] planning::PlanResult SearchContactPoints(const std::vector<grasp::Contact>& contacts,
                                                       const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
