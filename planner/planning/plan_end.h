#pragma once

#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"

namespace regrasp::planning {

/// State of a hand and its contacts at the end of a plan.
struct HandEnd {
  plan::HandState state;
  plan::FingerGrasp grasp;
};

/// Return the state after the last step of a plan for a hand.
/// @throws std::invalid_argument  if the plan has no hand.
[[nodiscard]] HandEnd EndOfPlan(const plan::Plan& plan);

/// Let a task start at the end of a plan.
/// Sets pose, joints and fingers; the start grasp of the request must be that of the end.
void StartFrom(const HandEnd& end, InHandTask& task);

}  // namespace regrasp::planning
