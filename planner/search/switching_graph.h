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

/// Unordered pair of vertices of a graph.
using VertexPair = std::pair<int, int>;
[[nodiscard]] inline VertexPair Unordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Graph of grasp sets connected by finger switches.
///
/// A vertex is a connected set of force-closure grasps. An edge is a finger switch between two of
/// them. A planner defines both. Edges are a function instead of a list, because a roadmap of a
/// hundred thousand vertices has millions of edges.
///
/// Laws: neighbourhood is symmetric and irreflexive. MinSwitches is symmetric, 0 from a vertex to
/// itself, at most 1 between neighbours, and satisfies the triangle inequality.
class SwitchingGraph {
 public:
  virtual ~SwitchingGraph() = default;

  /// Return the number of vertices, which are numbered from 0.
  [[nodiscard]] virtual int vertex_count() const = 0;

  /// Replace `neighbours` by the adjacent vertices of `vertex`, in a fixed order.
  virtual void GetNeighbours(int vertex, std::vector<int>& neighbours) const = 0;

  /// Return a lower bound of the number of switches between two vertices. It must be cheap; 0 is
  /// always valid.
  [[nodiscard]] virtual int MinSwitches(int from, int to) const {
    (void)from, (void)to;
    return 0;
  }

 protected:
  SwitchingGraph() = default;
  SwitchingGraph(const SwitchingGraph&) = default;
  SwitchingGraph& operator=(const SwitchingGraph&) = default;
};

/// Connected components of a graph.
struct Components {
  std::vector<int> of_vertex;  ///< component of each vertex; numbered by first vertices
  std::vector<int> sizes;      ///< number of vertices by component
  [[nodiscard]] int count() const { return static_cast<int>(sizes.size()); }
};

/// Find the connected components, given groups of mutually connected vertices.
/// A group of two is an edge. A larger group replaces its edges, for example all grasps that
/// contain the same three contacts.
/// @param members  vertices of a group.
[[nodiscard]] Components FindComponents(
    int vertex_count, int group_count,
    const std::function<std::span<const int>(int group)>& members);

/// Find the connected components of a graph with given edges.
/// @param ends  function from an edge to its two vertices.
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

/// Part of a graph that lies on paths with the fewest switches from `start` to `goal`.
struct ShortestPaths {
  int switches = 0;
  std::vector<int> depth;  ///< switches from the start by vertex; −1 off shortest paths
};

/// Find all shortest paths by bidirectional breadth-first search.
/// The smaller front is expanded by one layer at a time (Pohl 1971). The paths are then traced back
/// from the common vertices.
/// @returns nullopt if there is no path.
[[nodiscard]] std::optional<ShortestPaths> FindShortestPaths(const SwitchingGraph& graph, int start,
                                                             int goal);

/// Predicate whether a path may pass a vertex. It is called late but repeatedly, so implementations
/// should cache results.
using VertexFilter = std::function<bool(int vertex)>;

/// Return the fewest switches from `start` to `goal` over admitted vertices.
///
/// A* (Hart, Nilsson and Raphael 1968) with MinSwitches as its bound. `admits` is called only for
/// vertices that the search expands, because it can cost far more than the search. A breadth-first
/// search from the goal runs alternately, so that a small component on either side ends the search
/// early.
/// @param admits  filter of inner vertices; not called for `start` and `goal`.
/// @returns nullopt if there is no path.
[[nodiscard]] std::optional<int> FewestSwitches(const SwitchingGraph& graph, int start, int goal,
                                                const VertexFilter& admits);

/// Return the vertices that are reachable from `start` over admitted vertices, `start` included.
[[nodiscard]] std::vector<int> ReachableVertices(const SwitchingGraph& graph, int start,
                                                 const VertexFilter& admits);

/// Preference of a vertex; larger is better. Called late, like VertexFilter.
using VertexWidth = std::function<double(int vertex)>;

/// Return the path of exactly `switches` switches whose smallest width is largest.
///
/// `switches` is the result of FewestSwitches. Neither the width nor the filter is evaluated at the
/// ends, which every path contains. Ties are broken by the numbers of the vertices. The search is
/// best-first on the bottleneck (the widest path of Pollack 1960) over pairs of vertex and depth.
/// Widths are capped by the best first and the best last step, which bound every path. The search
/// therefore goes straight to the goal once its path is as wide as this cap.
/// @returns vertices from `start` to `goal`, both included; empty if no path has exactly `switches`
///     switches.
[[nodiscard]] std::vector<int> WidestPath(const SwitchingGraph& graph, int start, int goal,
                                          int switches, const VertexFilter& admits,
                                          const VertexWidth& width);

}  // namespace regrasp::search
