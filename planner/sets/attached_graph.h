#pragma once

#include <set>
#include <vector>

#include "planner/search/switching_graph.h"
#include "planner/sets/set_graph.h"

namespace regrasp::sets {

/// Grasp sets that are connected with the start or goal grasp.
struct GraspEnds {
  std::set<SetIndex> of_itself;  ///< sets that contain the grasp
  std::set<SetIndex> by_switch;  ///< sets reached by an additional finger switch
};

/// Switching graph with a start and a goal grasp as additional vertices, and without banned edges.
///
/// Sets that a grasp reaches by an additional finger switch are one edge farther than those that
/// contain it.
class AttachedGraph final : public search::SwitchingGraph {
 public:
  /// @param graph, banned  must outlive this object.
  AttachedGraph(const search::SwitchingGraph& graph, const GraspEnds& start, const GraspEnds& goal,
                const std::set<search::VertexPair>& banned)
      : graph_(graph),
        banned_(banned),
        start_{graph.vertex_count(), graph.vertex_count() + 2, start},
        goal_{graph.vertex_count() + 1, graph.vertex_count() + 3, goal} {}

  [[nodiscard]] int start() const { return start_.grasp; }
  [[nodiscard]] int goal() const { return goal_.grasp; }
  /// Whether a vertex is a grasp set, and not the start or goal before or after its additional
  /// switch.
  [[nodiscard]] bool IsSet(int vertex) const { return vertex < graph_.vertex_count(); }
  /// Whether every sequence passes this set, because it is the only set connected with an end.
  [[nodiscard]] bool IsOnlySetOfAnEnd(int vertex) const;

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count() + 4; }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 private:
  struct End {
    int grasp;
    int changed;  ///< vertex of the grasp after its additional switch
    GraspEnds sets;
  };
  static bool GetNeighboursOfEnd(const End& end, int vertex, std::vector<int>& neighbours);
  static void AddEnd(const End& end, SetIndex set, std::vector<int>& neighbours);

  const search::SwitchingGraph& graph_;
  const std::set<search::VertexPair>& banned_;
  End start_;
  End goal_;
};

}  // namespace regrasp::sets
