#pragma once

#include <string>

#include "planner/base/json.h"
#include "report/report.h"
#include "sim/actuation/condition_replays.h"

namespace regrasp::report {

/// Name of the reason of a plan whose steps and trials pass but too few of whose conditions do.
inline constexpr char kConditionsFailed[] = "conditions-failed";

/// Return the member `conditions` of report.json.
[[nodiscard]] Json ConditionsJson(const sim::ConditionSummary& summary);

/// Return "pass", "fail: slipped" or "not applicable".
[[nodiscard]] std::string ConditionVerdictText(const sim::ConditionResult& result);

/// Return "under 20 of 26 conditions".
[[nodiscard]] std::string ConditionsPassText(const sim::ConditionSummary& summary);

/// Return "20 of 26 pass, 23 of 26 end within the tolerance; required 90 %".
[[nodiscard]] std::string ConditionsShareText(const sim::ConditionSummary& summary);

/// Return "6 of 26 conditions fail: camera (slipped), blind (object-moved), …"; empty if none does.
[[nodiscard]] std::string ConditionsFailureText(const sim::ConditionSummary& summary);

/// Return "20 of 26 conditions pass (76.9 %), --require requires 90 %".
[[nodiscard]] std::string ConditionsRequiredText(const sim::ConditionSummary& summary);

/// Return a table with one row per condition; empty without conditions.
[[nodiscard]] std::string FormatConditionTable(const Report& report);

}  // namespace regrasp::report
