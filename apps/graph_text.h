#pragma once

#include <string>

#include "planner/base/json.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// Return the contents of a graph file (docs/formats.md).
[[nodiscard]] Json GraphJson(const planning::GraphSummary& summary, double friction_angle);

/// Return the text that `graph` prints.
/// It has tables of grasps and finger switches, times, and the additional values of the request.
[[nodiscard]] std::string GraphTable(const planning::GraphSummary& summary,
                                     const std::string& title);

/// Return the share of the direct graph that sampling finds, as text.
[[nodiscard]] std::string ShareText(const planning::SamplingShare& share);

}  // namespace regrasp::apps
