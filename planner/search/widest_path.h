#pragma once

#include <functional>
#include <vector>

#include "planner/search/fewest_switches.h"

namespace regrasp::search {

/// How good it is to pass a vertex; the more the better. Asked late, like VertexFilter.
using VertexWidth = std::function<double(int vertex)>;

/// Among all sequences of exactly `switches` switches, FewestSwitches' answer, the one whose
/// smallest width is largest: the vertices from `start` to `goal`, both included.
///
/// Neither the width nor the filter is asked of the ends, which every sequence passes. Among equals
/// the numbers of the vertices decide. Best-first on the bottleneck (the widest
/// path of Pollack 1960) over pairs of vertex and depth; widths count only up to the best first
/// and the best last step, which bound every sequence, so that the search dives to the goal once
/// it is as good as they let it be.
/// @returns an empty vector where no sequence has exactly `switches` switches.
[[nodiscard]] std::vector<int> WidestPath(const SwitchingGraph& graph, int start, int goal,
                                          int switches, const VertexFilter& admits,
                                          const VertexWidth& width);

}  // namespace regrasp::search
