#pragma once

#include <set>
#include <vector>

#include "planner/search/switching_graph.h"
#include "planner/search/vertex_pair.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace regrasp {

/// The switching graph of a polygon with a start and a goal grasp as vertices of their own, and
/// without some switches. Sets that a grasp comes to by a switch of its own are one switch farther
/// than those that it is in.
class AttachedGraph final : public SwitchingGraph {
 public:
  AttachedGraph(const PolygonGraph& graph, const std::vector<Attachment>& start,
                const std::vector<Attachment>& goal, const std::set<VertexPair>& banned);

  [[nodiscard]] int start() const { return graph_.vertex_count(); }
  [[nodiscard]] int goal() const { return graph_.vertex_count() + 1; }
  /// False for the vertices that stand for start and goal, before and after a switch of their own.
  [[nodiscard]] bool IsSet(int vertex) const { return vertex < graph_.vertex_count(); }

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count() + 4; }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 private:
  /// A grasp's vertices, and the sets joined to them.
  struct End {
    int grasp;
    int changed;  ///< the grasp once it has been switched
    std::set<int> of_itself;
    std::set<int> by_switch;
  };
  static End MakeEnd(int grasp, int changed, const std::vector<Attachment>& attachments);
  static bool GetNeighboursOfEnd(const End& end, int vertex, std::vector<int>& neighbours);
  static void AddEnd(const End& end, int set, std::vector<int>& neighbours);

  const PolygonGraph& graph_;
  const std::set<VertexPair>& banned_;
  End start_;
  End goal_;
};

/// The sets that a sequence with the fewest switches passes, of these the widest; empty where there
/// is none.
[[nodiscard]] std::vector<int> FindSetPath(const AttachedGraph& graph, GraphCells& cells);

}  // namespace regrasp
