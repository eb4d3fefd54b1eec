#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/search/switching_graph.h"

namespace regrasp::sets {

/// A set of grasps: a vertex of a SetGraph.
using SetIndex = Index<struct SetTag>;
/// Two sets that a switch joins.
using SetPair = std::array<SetIndex, 2>;

/// The switching graph of an object's grasp sets, with its edges as a list: what such graphs have
/// in common, whatever the sets.
class SetGraph : public search::SwitchingGraph {
 public:
  /// Pairs of sets that a switch joins; but for those of a kind of which each two are joined, where
  /// the object's graph has such a kind.
  [[nodiscard]] const std::vector<SetPair>& switches() const { return switches_; }
  [[nodiscard]] search::Components components() const;

  /// Wall time that the vertices and the edges took.
  [[nodiscard]] double vertex_seconds() const { return vertex_seconds_; }
  [[nodiscard]] double edge_seconds() const { return edge_seconds_; }

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(neighbours_.size()); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 protected:
  /// tan θ.
  /// @throws std::invalid_argument  θ is not in (0, π/2).
  static double CheckedTangent(double half_angle);

  // A graph calls these in this order while it is built.
  void BeginVertices();
  void EndVertices(int count);
  /// @param all_joined  ascending; sets of which each two are joined.
  void EndEdges(std::vector<SetPair> switches, const std::vector<SetIndex>& all_joined = {});

 private:
  std::vector<SetPair> switches_;
  std::vector<int> all_joined_;
  std::vector<std::vector<int>> neighbours_;  ///< over switches_, ascending
  Stopwatch stopwatch_;
  double vertex_seconds_ = 0;
  double edge_seconds_ = 0;
};

}  // namespace regrasp::sets
