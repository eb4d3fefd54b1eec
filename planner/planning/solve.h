#pragma once

#include "planner/planning/planner.h"

namespace regrasp::planning {

/// Plans by a planner: checks the request, given grasps and what the planner would take, draws
/// grasps evenly over the surface, and turns NoGrasp and TimeUp into results.
///
/// Laws: without a deadline the same arguments give the same plan, bit for bit; a goal equal to the
/// start as a set gives no steps; every grasp at rest and in between is force closure.
/// @throws InputError             the planner does not serve the request (WhyNotServed), or a given
///                                grasp has another number of contacts than it takes, two at the
///                                same point, is not force closure, or fingers of the hand cannot
///                                stand in it.
/// @throws std::invalid_argument  friction or quality is out of its range.
[[nodiscard]] PlanResult Solve(const Planner& planner, const PlanRequest& request);

}  // namespace regrasp::planning
