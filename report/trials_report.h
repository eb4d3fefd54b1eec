#pragma once

#include <string>

#include "planner/base/json.h"
#include "sim/replay/trials.h"

namespace regrasp::report {

/// The member `trials` of report.json (docs/formats.md).
[[nodiscard]] Json TrialsJson(const sim::TrialSummary& summary);

/// "in 14 of 20 trials", behind "pass": there is no verdict on trials without their numbers.
[[nodiscard]] std::string TrialsPassText(const sim::TrialSummary& summary);

/// "14 of 20 trials pass (70 %), and --min-pass-rate requires 100 %".
[[nodiscard]] std::string TrialsRequiredText(const sim::TrialSummary& summary);

/// "93 of 100 pass: 93 %, with 95 % confidence between 86.1 and 97.1 %; required 100 %".
[[nodiscard]] std::string TrialsShareText(const sim::TrialSummary& summary);

/// "7 of 100 trials with noise fail: 5 slipped, 2 object-moved; first in step 0: 4, step 3: 3";
/// empty if none failed.
[[nodiscard]] std::string TrialsFailureText(const sim::TrialSummary& summary);

/// "contacts off by 0.01 diameters, friction by 10 %, mass by 10 % (standard deviations); seed 0".
[[nodiscard]] std::string TrialsNoiseText(const sim::TrialSummary& summary);

}  // namespace regrasp::report
