#pragma once

#include <functional>
#include <optional>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"

namespace regrasp::sim {

/// Return a function that simulates the execution of plans for planners (planning::InHandTask).
/// It replays a plan on the hand's own model (ReplayHand) with the plan's friction, for an object
/// with the density of water, including disturbance tests. Several threads may call it at a time.
///
/// @param solid  object; must outlive the function.
/// @returns a function that stops after the present step at its deadline, and returns nullopt if
///     the hand's model cannot be simulated.
[[nodiscard]] std::function<std::optional<planning::ExecutionResult>(const plan::Plan&,
                                                                     const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid);

}  // namespace regrasp::sim
