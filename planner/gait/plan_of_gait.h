#pragma once

#include "planner/gait/find_gait.h"
#include "planner/plan/plan.h"

namespace regrasp::gait {

/// The plan that a gait is, all but the object's file and digest: finger numbers are those of the
/// hand, a placed and the next released finger are one switch.
[[nodiscard]] plan::Plan PlanOf(const Gait& gait, const GaitRequest& request,
                                const std::vector<grasp::Contact>& contacts);

/// Of the first steps of a gait's plan how many of its stretches are no moves.
[[nodiscard]] int CountChanges(const Gait& gait, int steps);

}  // namespace regrasp::gait
