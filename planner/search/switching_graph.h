#pragma once

#include <vector>

namespace regrasp::search {

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

}  // namespace regrasp::search
