#pragma once

#include <set>
#include <vector>

#include "planner/search/switching_graph.h"
#include "planner/sets/set_graph.h"

namespace regrasp::sets {

/// The sets that a grasp is joined to.
struct GraspEnds {
  std::set<SetIndex> of_itself;  ///< that it is in
  std::set<SetIndex> by_switch;  ///< that it comes to by a switch of its own
};

/// A switching graph with a start and a goal grasp as vertices of their own, and without some
/// switches. Sets that a grasp comes to by a switch of its own are one switch farther than those
/// that it is in.
class AttachedGraph final : public search::SwitchingGraph {
 public:
  /// @param graph, banned  outlive this object.
  AttachedGraph(const search::SwitchingGraph& graph, const GraspEnds& start, const GraspEnds& goal,
                const std::set<search::VertexPair>& banned)
      : graph_(graph),
        banned_(banned),
        start_{graph.vertex_count(), graph.vertex_count() + 2, start},
        goal_{graph.vertex_count() + 1, graph.vertex_count() + 3, goal} {}

  [[nodiscard]] int start() const { return start_.grasp; }
  [[nodiscard]] int goal() const { return goal_.grasp; }
  /// False for the vertices that stand for start and goal, before and after a switch of their own.
  [[nodiscard]] bool IsSet(int vertex) const { return vertex < graph_.vertex_count(); }
  /// Whether every sequence passes this set, because an end is joined to no other.
  [[nodiscard]] bool IsOnlySetOfAnEnd(int vertex) const;

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count() + 4; }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 private:
  struct End {
    int grasp;
    int changed;  ///< the grasp once it has been switched
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
