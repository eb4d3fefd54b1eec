#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace regrasp::search {

/// Two vertices of a graph, in either order.
using VertexPair = std::pair<int, int>;
[[nodiscard]] inline VertexPair Unordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// A graph of grasp sets joined by finger switches, as a search sees it.
///
/// A vertex is a connected set of force-closure grasps, an edge a switch between two of them; a
/// planner supplies both and nothing else. Edges are given by a function and not as a list, because
/// a roadmap of a hundred thousand vertices has millions of them.
///
/// Laws: neighbours are mutual and never the vertex itself; MinSwitches is symmetric, 0 from a
/// vertex to itself, at most 1 between neighbours, and obeys the triangle inequality.
class SwitchingGraph {
 public:
  virtual ~SwitchingGraph() = default;

  /// Vertices are numbered from 0.
  [[nodiscard]] virtual int vertex_count() const = 0;

  /// Replaces `neighbours` by the vertices that are one switch away, in a fixed order.
  virtual void GetNeighbours(int vertex, std::vector<int>& neighbours) const = 0;

  /// A lower bound on the switches between two vertices, cheap to get. 0 is always one.
  [[nodiscard]] virtual int MinSwitches(int from, int to) const {
    (void)from, (void)to;
    return 0;
  }

 protected:
  SwitchingGraph() = default;
  SwitchingGraph(const SwitchingGraph&) = default;
  SwitchingGraph& operator=(const SwitchingGraph&) = default;
};

/// The connected components of a graph.
struct Components {
  std::vector<int> of_vertex;  ///< numbered from 0 in the order of their first vertices
  std::vector<int> sizes;      ///< vertices of each
  [[nodiscard]] int count() const { return static_cast<int>(sizes.size()); }
};

/// Components where all vertices of a group are joined to each other. A group of two is an edge; a
/// larger one spares its edges (all grasps that contain the same three contacts, say).
/// @param members  the vertices of a group.
[[nodiscard]] Components FindComponents(
    int vertex_count, int group_count,
    const std::function<std::span<const int>(int group)>& members);

/// Components of a graph with these edges. @param ends  gives an edge's two vertices.
template <class Edges, class Ends = std::identity>
[[nodiscard]] Components ComponentsOfEdges(int vertex_count, const Edges& edges,
                                           const Ends& ends = {}) {
  std::array<int, 2> pair;
  return FindComponents(vertex_count, static_cast<int>(std::ssize(edges)), [&](int edge) {
    const auto& [a, b] = std::invoke(ends, edges[edge]);
    pair = {a, b};
    return std::span<const int>(pair);
  });
}

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
