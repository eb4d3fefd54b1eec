#pragma once

#include <algorithm>
#include <utility>

namespace regrasp::search {

/// Two vertices of a graph, in either order.
using VertexPair = std::pair<int, int>;
[[nodiscard]] inline VertexPair Unordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace regrasp::search
