#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/object.h"
#include "planner/planning/planner.h"
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
  std::set<SetIndex> of_itself;  ///< sets that contain the grasp
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

/// Lists of sets from which a random grasp is drawn, in this order.
using SamplingPools = std::vector<std::vector<SetIndex>>;

/// Draw a standard normal deviate from two uniform ones (Box and Muller 1958).
///
/// A vector of them has a uniformly distributed direction.
[[nodiscard]] double DrawNormal(RandomStream& random);

/// Return the pools for a start: all sets.
[[nodiscard]] SamplingPools StartPools(int set_count);
/// Return the pools for a goal: first all other sets in the components of the start's sets, then
/// the start's own sets.
[[nodiscard]] SamplingPools GoalPools(const search::Components& components,
                                      const std::set<SetIndex>& start_sets);

/// Draw sets from pools and grasps from sets until a grasp meets the acceptance criteria.
/// @param name  name of the grasp for messages.
/// @param draw  function that returns a random grasp of a set; an empty one if none is found.
/// @throws NoGrasp  if none of many draws meets the criteria.
[[nodiscard]] grasp::Grasp DrawFromSets(const std::string& name, SamplingPools pools,
                                        const std::function<grasp::Grasp(SetIndex set)>& draw,
                                        const criteria::GraspEvaluator& evaluator,
                                        RandomStream& random);

/// Numbers of elements of a switching graph that take memory during construction; or the bytes per
/// element, including spare capacity of vectors.
struct GraphSize {
  double candidates = 0;
  double sets = 0;
  double switches = 0;

  /// Compute the total number of bytes.
  [[nodiscard]] constexpr double Times(const GraphSize& bytes) const {
    return candidates * bytes.candidates + sets * bytes.sets + switches * bytes.switches;
  }
};

/// Measured constants of graphs in which two sets are connected if they have common faces.
struct JoinedGraph {
  GraphSize bytes;
  int common_faces = 0;  ///< number of faces that two connected sets have in common
  /// Number of switches · faces^common_faces / sets².
  double switches = 0;

  /// Compute the total number of bytes of a graph on n faces. @param size  numbers without
  /// switches.
  [[nodiscard]] double BytesOf(GraphSize size, double n) const;
};

/// Draw at most `most` faces on which an estimate counts; returned in ascending order.
[[nodiscard]] std::vector<FaceIndex> DrawFaces(const object::Object& object, int most,
                                               RandomStream random);

/// Scale a count of combinations of `faces` faces among m faces to n faces.
[[nodiscard]] double ScaleUp(double counted, int faces, double m, double n);

/// Make the memory estimate of a planner's graph. @param bytes_for  bytes by number of faces.
[[nodiscard]] MemoryNeed NeedOfGraph(const std::string& planner, const object::Object& object,
                                     std::function<double(double)> bytes_for);

/// Make the common part of the summaries of all graphs: everything except types and edges.
template <class Graph>
[[nodiscard]] planning::GraphSummary SummaryOf(const Graph& graph, const object::Object& object,
                                               const std::string& planner) {
  planning::GraphSummary summary;
  summary.planner = planner;
  summary.faces = object.face_count();
  summary.face_name = object.dimension() == 2 ? "edges" : "faces";
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  return summary;
}

}  // namespace regrasp::sets
