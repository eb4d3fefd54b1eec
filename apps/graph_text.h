#pragma once

#include <string>

#include "planner/base/json.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// A graph file's contents (docs/formats.md).
[[nodiscard]] Json GraphJson(const planning::GraphSummary& summary, double half_angle);

/// What `graph` prints: tables of grasps and switches, times, and what was asked for besides.
[[nodiscard]] std::string GraphTable(const planning::GraphSummary& summary,
                                     const std::string& title);

/// How many of the direct graph's sets sampling found, and of its links.
[[nodiscard]] std::string ShareText(const planning::SamplingShare& share);

}  // namespace regrasp::apps
