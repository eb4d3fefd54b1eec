#pragma once

#include "planner/base/json.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// The parts of a plan's file that say how a hand moves (docs/plan.schema.json).
/// @throws InputError
[[nodiscard]] HandUse ReadHandUse(const JsonReader& json);
[[nodiscard]] HandPath ReadHandPath(const JsonReader& json);
[[nodiscard]] SwitchMotion ReadSwitchMotion(const JsonReader& json);

/// Doubles read back as the same bits.
[[nodiscard]] Json HandUseJson(const HandUse& hand);
[[nodiscard]] Json HandPathJson(const HandPath& path);
[[nodiscard]] Json SwitchMotionJson(const SwitchMotion& motion);

/// 64 lower-case hexadecimal digits.
[[nodiscard]] std::string ReadSha256(const JsonReader& json);

}  // namespace regrasp::plan
