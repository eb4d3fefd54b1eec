#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {

/// Conditions under which a planner simulates its candidates.
enum class PlanningRobustness {
  kNominal,   ///< the nominal replay
  kStandard,  ///< errors of sensors and physics first, then the nominal replay
};

/// Return the conditions of a robustness, hardest first.
[[nodiscard]] std::vector<HandReplayOptions> PlanningConditions(PlanningRobustness robustness);

/// Return a function that simulates the execution of plans for planners (planning::InHandTask).
/// It replays a plan on the hand's own model (ReplayHand) with the plan's friction and mass, under
/// each condition in turn. A plan executes if it does under all;
/// the result is that of the first condition that fails. Several threads may call it at a time.
///
/// @param solid  object; must outlive the function.
/// @returns a function that stops after the present step at its deadline, and returns nullopt if
///     an independent joint of the hand has no actuator. It throws InputError if the hand's model
///     or the object's mass cannot be simulated for another reason.
[[nodiscard]] std::function<std::optional<planning::ExecutionResult>(const plan::Plan&,
                                                                     const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid,
                   std::vector<HandReplayOptions> conditions = {HandReplayOptions()});

/// Return a function that rates plans for planners (planning::InHandTask::rate).
/// It replays a plan with its friction and mass under the standard conditions that exist for the
/// hand. The conditions that fail most often are first, and a replay ends at its first failed step.
/// @param solid  object; must outlive the function.
[[nodiscard]] std::function<std::optional<planning::RobustnessRating>(
    const plan::Plan&, int most_failures, const Deadline&)>
ExecutionRater(kinematics::HandFile file, const object::Polyhedron& solid);

/// Return a function that measures grasp forces for planners (planning::InHandTask::measure_force).
/// It calls MeasureGraspForce for an object with the density of water.
/// @param solid  object; must outlive the function.
/// @returns a function that returns nullopt if the hand's model cannot be simulated.
[[nodiscard]] std::function<std::optional<planning::GraspForceNeed>(const plan::Plan&, int steps)>
GraspForceMeter(kinematics::HandFile file, const object::Polyhedron& solid);

}  // namespace regrasp::sim
