#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/search/switching_graph.h"

namespace regrasp::sets {

/// Index of a set of grasps, which is a vertex of a SetGraph.
using SetIndex = Index<struct SetTag>;
/// Two sets that are connected by a switch.
using SetPair = std::array<SetIndex, 2>;

/// Switching graph of an object's grasp sets with an explicit list of edges: the common base of all
/// such graphs.
class SetGraph : public search::SwitchingGraph {
 public:
  /// Pairs of sets that are connected by a switch. If all sets of one kind are connected with each
  /// other, these pairs are omitted.
  [[nodiscard]] const std::vector<SetPair>& switches() const { return switches_; }
  [[nodiscard]] search::Components components() const;

  /// Wall time for the computation of vertices or edges, s.
  [[nodiscard]] double vertex_seconds() const { return vertex_seconds_; }
  [[nodiscard]] double edge_seconds() const { return edge_seconds_; }

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(neighbours_.size()); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 protected:
  /// Compute tan θ.
  /// @throws std::invalid_argument  if θ is not in (0, π/2).
  static double CheckedTangent(double half_angle);

  // Stages of construction; a derived graph calls them in this order.
  void BeginVertices();
  void EndVertices(int count);
  /// @param all_joined  sets that are all connected with each other, in ascending order.
  void EndEdges(std::vector<SetPair> switches, const std::vector<SetIndex>& all_joined = {});

 private:
  std::vector<SetPair> switches_;
  std::vector<int> all_joined_;
  std::vector<std::vector<int>> neighbours_;  ///< neighbours of each set by switches_, ascending
  Stopwatch stopwatch_;
  double vertex_seconds_ = 0;
  double edge_seconds_ = 0;
};

}  // namespace regrasp::sets
