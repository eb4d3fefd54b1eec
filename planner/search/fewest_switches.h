#pragma once

#include <functional>
#include <optional>

#include "planner/search/switching_graph.h"

namespace regrasp::search {

/// Whether a sequence may pass a vertex. Asked late and often: whoever answers should remember.
using VertexFilter = std::function<bool(int vertex)>;

/// The fewest switches from `start` to `goal` over vertices that `admits` lets pass (not asked of
/// the two ends); nullopt where there is no path.
///
/// A* (Hart, Nilsson and Raphael 1968) with MinSwitches as its bound: `admits` is asked only of
/// vertices on the search's own front, as it may cost far more than the search. A flood from the
/// goal runs beside it, step by step, so that a small component on either side ends the search
/// early.
[[nodiscard]] std::optional<int> FewestSwitches(const SwitchingGraph& graph, int start, int goal,
                                                const VertexFilter& admits);

/// Vertices that a sequence from `start` can reach over `admits`, `start` included.
[[nodiscard]] std::vector<int> ReachableVertices(const SwitchingGraph& graph, int start,
                                                 const VertexFilter& admits);

}  // namespace regrasp::search
