#pragma once

#include "planner/base/json.h"
#include "sim/measure/weakest_finger.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"

namespace regrasp::report {

/// "adapted", "fixed" or "both".
[[nodiscard]] const char* ProtocolName(sim::Protocol protocol);

/// "mujoco", "ode" or "both".
[[nodiscard]] const char* EngineName(sim::EngineChoice engine);

/// "shake", "hand" or "option".
[[nodiscard]] const char* SqueezeSourceName(sim::SqueezeSource source);

/// The member `simulation` of an entry: motion, slip, cone margins.
[[nodiscard]] Json SimulationJson(const sim::StepReplay& replay);

/// The member `hand` of the settings, of a replay by a hand.
[[nodiscard]] Json HandSettingsJson(const sim::HandReplaySettings& settings);

/// The member `protocols`: what each protocol that ran says.
[[nodiscard]] Json ProtocolsJson(const sim::StepReplay& replay);

/// The member `engines`: what each engine says, and the likely cause where they differ.
/// @pre both replayed the step.
[[nodiscard]] Json EnginesJson(const sim::StepReplay& replay,
                               const std::optional<sim::Disagreement>& between);

/// The member `stress`: an array with an element for each direction.
[[nodiscard]] Json StressJson(const std::vector<sim::DirectionStress>& stress);

/// The member `cause`; null where nothing disagrees.
[[nodiscard]] Json CauseJson(const std::optional<sim::Disagreement>& disagreement);

/// What one finger needs of its own friction.
[[nodiscard]] Json FingerNeedJson(FingerIndex finger, const grasp::FingerFriction& friction,
                                  double half_angle);

}  // namespace regrasp::report
