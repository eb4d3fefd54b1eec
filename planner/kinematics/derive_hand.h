#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"

namespace regrasp::kinematics {

struct CompiledModel;

struct DerivedHand {
  HandDescription description;     ///< without the file of the model
  std::vector<std::string> notes;  ///< what is doubtful, and what was left out
};

/// Says of a model without being told which of its bodies are what:
///
/// - A fingertip is a body that collides and has none below it that does. Where several share a
///   joint, the one with the longest chain is taken.
/// - The palm is the lowest body that all fingertips are below of.
/// - The tip's ball is fitted (FitTip) to the geom of the tip's body that reaches farthest from the
///   last joint; its pad is where the last joint's flexion, the longer side of its range, turns it.
/// - Up is the direction to which more than two thirds of the fingers flex; otherwise where they
///   point, at rest. An axis of the palm that is within 10° is taken for it.
/// - A joint follows another one where an equality constraint or a <mimic> says so, or a tendon of
///   one actuator is made of both; the one with an actuator leads.
/// - Names come from the bodies, less what all of them begin or end with.
/// @throws InputError  fewer than three fingers, or no body in common but the world.
[[nodiscard]] DerivedHand DeriveHand(const CompiledModel& compiled, const std::string& file);

}  // namespace regrasp::kinematics
