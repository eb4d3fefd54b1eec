#pragma once

#include <optional>
#include <vector>

#include "planner/search/switching_graph.h"

namespace regrasp::search {

/// The part of a graph that the sequences with the fewest switches from `start` to `goal` pass.
struct ShortestPaths {
  int switches = 0;
  std::vector<int> depth;  ///< of each vertex: switches from the start; −1 where none passes it
};

/// Breadth-first search from both ends at once, a layer at a time on the side whose front is
/// smaller (Pohl 1971), then back to the ends from where the two meet.
/// @returns nullopt where there is no path.
[[nodiscard]] std::optional<ShortestPaths> FindShortestPaths(const SwitchingGraph& graph, int start,
                                                             int goal);

}  // namespace regrasp::search
