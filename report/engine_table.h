#pragma once

#include <string>
#include <vector>

#include "planner/base/json.h"
#include "sim/validation/engine_results.h"

namespace regrasp::report {

/// Format the results of a hand replay in each engine as a table; empty for other replays.
[[nodiscard]] std::string FormatEngineTable(const validation::Report& report);

/// Return the member `engines` of a report.
[[nodiscard]] Json EngineResultsJson(const std::vector<validation::EngineResult>& results);

}  // namespace regrasp::report
