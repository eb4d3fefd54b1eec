#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "report/report.h"
#include "sim/measure/disturbance.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"

namespace regrasp::report {

/// Return the value, or null if there is none.
template <class Value>
[[nodiscard]] Json OrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Return the text, or null if it is empty.
[[nodiscard]] inline Json TextOrNull(std::string_view text) {
  return text.empty() ? Json(nullptr) : Json(std::string(text));
}

/// Return the number of an entry or a finger, or null if it is negative (none).
[[nodiscard]] inline Json IndexOrNull(int index) { return index < 0 ? Json(nullptr) : Json(index); }

/// Return an angle in radians as degrees, or null.
[[nodiscard]] inline Json DegreesOrNull(const std::optional<double>& angle) {
  return angle ? Json(Degrees(*angle)) : Json(nullptr);
}

/// Return the text of a report, sealed if it has the member `run`.
/// The seal is `run/report_sha256`, the SHA-256 of the text without that member.
///
/// It detects an edited report. It is not a signature: an editor can recompute it.
/// @param report  report as JSON; `run` is an object or missing.
[[nodiscard]] std::string SealReport(Json report);

/// Return whether a text is exactly an output of SealReport for a report with `run`.
/// @throws InputError  if it is not JSON.
[[nodiscard]] bool IsSealed(std::string_view text);

/// Return "adapted", "fixed" or "both".
[[nodiscard]] const char* ProtocolName(sim::Protocol protocol);

/// Return "mujoco", "ode" or "both".
[[nodiscard]] const char* EngineName(sim::EngineChoice engine);

/// Return the name of the source in report.json, such as "hand" or "option".
[[nodiscard]] const char* GraspForceSourceName(sim::GraspForceSource source);

/// Return the member `simulation` of an entry: motion, slip, friction margins.
[[nodiscard]] Json SimulationJson(const sim::StepReplay& replay);

/// Return the member `hand` of the settings of a replay by a hand.
[[nodiscard]] Json HandSettingsJson(const sim::HandReplaySettings& settings);

/// Return the member `protocols`: the results of each protocol that ran.
[[nodiscard]] Json ProtocolsJson(const sim::StepReplay& replay);

/// Return the member `engines`: the results of each engine.
/// It includes the likely cause if the engines differ.
/// @pre both replayed the step.
[[nodiscard]] Json EnginesJson(const sim::StepReplay& replay,
                               const std::optional<sim::Disagreement>& between);

/// Return the member `resisted_wrench`: an array with an element for each direction.
[[nodiscard]] Json ResistedWrenchesJson(const std::vector<sim::ResistedWrench>& resisted_wrench);

/// Return the member `cause`; null if nothing disagrees.
[[nodiscard]] Json CauseJson(const std::optional<sim::Disagreement>& disagreement);

/// Return the friction that one finger requires.
[[nodiscard]] Json FingerNeedJson(FingerIndex finger, const grasp::FingerFriction& friction,
                                  double friction_angle);

/// Return the content of report.json without its seal (FormatReportJson).
[[nodiscard]] Json ReportJson(const Report& report);

}  // namespace regrasp::report
