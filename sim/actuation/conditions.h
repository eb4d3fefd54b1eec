#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {

/// A condition under which a plan is replayed: differences from the nominal replay.
/// The members of `changes` are those of docs/conditions.md.
struct HandCondition {
  std::string name;            ///< unique name: "friction-minus-10"
  std::string changes = "{}";  ///< JSON object
};

/// Read a list of conditions (docs/conditions.schema.json).
///
///     [{"name": "light", "mass_factor": 0.5}, {"name": "blind", "feedback": "none"}]
///
/// @param file  name of the file in messages.
/// @throws InputError  if the text does not match the schema, or two conditions have the same name.
[[nodiscard]] std::vector<HandCondition> ReadConditions(std::string_view text,
                                                        const std::string& file);

/// Return the standard conditions, in the order of docs/conditions.md.
[[nodiscard]] const std::vector<HandCondition>& StandardConditions();

/// Return the options of a replay under a condition.
/// It has no disturbance test and no test under constant controls, and continues after a failed
/// step (HandReplayOptions::to_end).
[[nodiscard]] HandReplayOptions OptionsUnder(const HandCondition& condition,
                                             const HandReplayOptions& nominal);

}  // namespace regrasp::sim
