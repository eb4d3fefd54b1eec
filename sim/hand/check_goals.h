#pragma once

#include <optional>

#include "planner/plan/plan.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {

/// Check the goals that a plan marks at an entry, and the final pose after its last step.
/// @param entry  number of the step; 0: the initial grasp.
/// @param state  state of the hand after the step.
/// @returns the first goal whose set does not contain the object's pose, to 1e-6 m and 1e-6 rad;
///     nullopt if there is none.
[[nodiscard]] std::optional<HandFinding> CheckGoals(const plan::Plan& plan, int entry,
                                                    const plan::HandState& state);

}  // namespace regrasp::sim
