#pragma once

#include <string>

#include "planner/base/json.h"
#include "sim/replay/trials.h"

namespace regrasp::report {

/// The member `trials` of report.json (docs/formats.md).
[[nodiscard]] Json TrialsJson(const sim::TrialSummary& summary);

/// "93 of 100 pass: 93 %, with 95 % confidence between 86.1 and 97.1 %".
[[nodiscard]] std::string TrialsShareText(const sim::TrialSummary& summary);

/// "5 slipped, 2 object-moved; first in step 0: 4, step 3: 3"; empty where none failed.
[[nodiscard]] std::string TrialsFailureText(const sim::TrialSummary& summary);

/// "contacts off by 0.01 diameters, friction by 10 %, mass by 10 % (standard deviations); seed 0".
[[nodiscard]] std::string TrialsNoiseText(const sim::TrialSummary& summary);

}  // namespace regrasp::report
