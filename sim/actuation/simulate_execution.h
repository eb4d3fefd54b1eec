#pragma once

#include <functional>
#include <optional>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"

namespace regrasp::sim {

/// Tells how far a hand carries a plan out: replayed on its own model (ReplayHand) with the plan's
/// friction, for a body of the density of water, shakes included. For planners that look for plans
/// that it does (planning::InHandTask). Several threads may ask at a time.
///
/// @param solid  outlives what is returned.
/// @returns what tells of a plan, at its deadline after the entry that is replayed then; nullopt
///          where the hand's model can't be simulated.
[[nodiscard]] std::function<std::optional<planning::ExecutionResult>(const plan::Plan&,
                                                                     const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid);

}  // namespace regrasp::sim
