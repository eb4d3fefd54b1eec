#pragma once

#include "planner/planning/planner.h"

namespace regrasp::planning {

/// Plan with a planner: the entry point for all planners.
///
/// It checks the request, the given grasps and the memory estimate, draws grasps uniformly on the
/// surface, and converts NoGrasp and TimeUp to results.
///
/// Laws: without a deadline the same arguments give the same plan, bit for bit. A goal that equals
/// the start as a set gives a plan without steps. Every static grasp, and every instant in between,
/// is force closure.
/// @throws InputError             if the planner does not serve the request (WhyNotServed), or a
///     given grasp is unsuitable: its number of contacts, two contacts at one point, no force
///     closure, or no room for the fingers of the hand.
/// @throws std::invalid_argument  if friction or quality is out of range.
[[nodiscard]] PlanResult Solve(const Planner& planner, const PlanRequest& request);

}  // namespace regrasp::planning
