#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "report/report.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"

namespace regrasp::report {

/// The squeeze and why it is what it is: "2119 N, 1000 times the weight: …".
[[nodiscard]] std::string SqueezeText(const sim::ReplaySettings& settings);

/// The direction of a report in which a rest resists least, by the replay.
struct WeakestPush {
  plan::EntryIndex step{0};
  sim::DirectionStress stress;
};

/// Nullopt where no entry has been searched for it.
[[nodiscard]] std::optional<WeakestPush> FindWeakestPush(const Report& report);

/// For each entry the largest push in each direction in percent of the squeeze, by the replay, the
/// smallest of all and what the analysis says of it; empty where there is none.
[[nodiscard]] std::string FormatStressTable(const Report& report);

/// The member `trials` of report.json (docs/formats.md).
[[nodiscard]] Json TrialsJson(const sim::TrialSummary& summary);

/// "in 14 of 20 trials", behind "pass": there is no verdict on trials without their numbers.
[[nodiscard]] std::string TrialsPassText(const sim::TrialSummary& summary);

/// "14 of 20 trials pass (70 %), and --trials min-pass-rate requires 100 %".
[[nodiscard]] std::string TrialsRequiredText(const sim::TrialSummary& summary);

/// "93 of 100 pass: 93 %, with 95 % confidence between 86.1 and 97.1 %; required 100 %".
[[nodiscard]] std::string TrialsShareText(const sim::TrialSummary& summary);

/// "7 of 100 trials with noise fail: 5 slipped, 2 object-moved; first in step 0: 4, step 3: 3";
/// empty if none failed.
[[nodiscard]] std::string TrialsFailureText(const sim::TrialSummary& summary);

/// "contacts off by 0.01 diameters, friction by 10 %, mass by 10 % (standard deviations); seed 0".
[[nodiscard]] std::string TrialsNoiseText(const sim::TrialSummary& summary);

}  // namespace regrasp::report
