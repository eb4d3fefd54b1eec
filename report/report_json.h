#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "report/report.h"
#include "sim/measure/weakest_finger.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"

namespace regrasp::report {

/// The value, or null where there is none.
template <class Value>
[[nodiscard]] Json OrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// The text; an empty one is null.
[[nodiscard]] inline Json TextOrNull(std::string_view text) {
  return text.empty() ? Json(nullptr) : Json(std::string(text));
}

/// The number of an entry or a finger; null where it is negative: none.
[[nodiscard]] inline Json IndexOrNull(int index) { return index < 0 ? Json(nullptr) : Json(index); }

/// An angle in radians as degrees, or null.
[[nodiscard]] inline Json DegreesOrNull(const std::optional<double>& angle) {
  return angle ? Json(Degrees(*angle)) : Json(nullptr);
}

/// The text of a report; where the report has the member `run`, with `run/report_sha256` in it, the
/// SHA-256 of the text without that.
///
/// It tells an edited report from one as it was written. It is no signature: who edits can compute
/// it anew.
/// @param report  `run`, where it is there, is an object.
[[nodiscard]] std::string SealReport(Json report);

/// Whether a text is what SealReport returned for a report with `run`, to the byte.
/// @throws InputError  it is not JSON.
[[nodiscard]] bool IsSealed(std::string_view text);

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

/// The report as report.json has it, without its seal (FormatReportJson).
[[nodiscard]] Json ReportJson(const Report& report);

}  // namespace regrasp::report
