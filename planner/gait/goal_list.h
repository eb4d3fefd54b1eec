#pragma once

#include <optional>
#include <string>

#include "planner/gait/request.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"

namespace regrasp::gait {

/// Result of a search of a plan through a list of goals.
struct GoalListResult {
  std::optional<plan::Plan> plan;  ///< plan with a mark for each goal
  /// Result of the simulated execution of the whole plan, as in GaitResult.
  std::optional<planning::ExecutionResult> execution;
  std::string message;  ///< first goal that is not reached, with the reason
};

/// Append a plan that starts at the end of another one, for the same hand and object.
/// Its steps follow, and its goal is marked after the last of them. It replaces a plan without
/// steps, of which only the pose at the end is that of its start.
[[nodiscard]] plan::Plan Joined(const std::optional<plan::Plan>& before, const plan::Plan& after,
                                const plan::NamedGoal& goal);

/// Let a task start at the end of a plan.
/// Sets pose, joints and fingers; the start grasp of the request must be that of the end.
void StartFrom(const plan::HandEnd& end, planning::InHandTask& task);

/// Let a task end at a state, of which joint angles are free.
/// Sets goal pose and fingers; the goal grasp of the request must be that of the end.
void EndAt(const plan::HandEnd& end, const plan::PoseTolerance& tolerance,
           planning::InHandTask& task);

/// Find a plan that reaches the goals of a request one after the other.
/// A depth-first search over end states. For each goal it finds up to three end states, each with a
/// gait from the end of the previous goal (FindGait). It continues with an end state from which a
/// short search without simulation reaches the next goal, and tries other ones later. If the next
/// goal is not reached, it returns to the previous goal and finds another end state. If the first
/// goals require no step, the initial grasp is selected for the next one.
/// Every plan is simulated from the initial grasp.
/// Law: a list with one goal gives the plan of that goal.
/// @throws std::invalid_argument, InputError  as FindGait.
[[nodiscard]] GoalListResult FindPlanThroughGoals(const GaitRequest& request);

}  // namespace regrasp::gait
