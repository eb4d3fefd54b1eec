#pragma once

#include <array>
#include <cstdint>
#include <set>
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
  static double CheckedTangent(double friction_angle);

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

/// Grasp sets that are connected with the start or goal grasp.
struct GraspEnds {
  std::set<SetIndex> of_itself;  ///< that contain the grasp
  std::set<SetIndex> by_switch;  ///< reached by one finger switch from the grasp
};

/// A switching graph with a start and a goal grasp as vertices of their own, and without some
/// switches. Sets that a grasp reaches by a switch of its own are one switch farther than those
/// that contain it.
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
  /// False for the vertices of start and goal, before and after a switch of their own.
  [[nodiscard]] bool IsSet(int vertex) const { return vertex < graph_.vertex_count(); }
  /// Whether every sequence passes this set, because start or goal is joined to this set only.
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
