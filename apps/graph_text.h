#pragma once

#include <string>

#include "apps/graph_summary.h"
#include "planner/base/json.h"

namespace regrasp::apps {

/// A graph file's contents (docs/formats.md).
[[nodiscard]] Json GraphJson(const GraphSummary& summary, double half_angle);

/// What `graph` prints: tables of grasps and switches, times, and what was asked for besides.
[[nodiscard]] std::string GraphTable(const GraphSummary& summary, const std::string& title);

/// " contact points, ": what `faces` counts, inside a title.
[[nodiscard]] std::string FacesName(const std::string& planner);

/// How many of the direct graph's sets sampling found, and of its links.
[[nodiscard]] std::string ShareText(const polyhedron::SamplingShare& share);

}  // namespace regrasp::apps
