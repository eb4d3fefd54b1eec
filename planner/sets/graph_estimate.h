#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/object/object.h"
#include "planner/planning/planner.h"

namespace regrasp::sets {

/// How much a switching graph has of what takes memory while it is built; or the bytes that each of
/// these takes, with what vectors keep to grow into.
struct GraphSize {
  double candidates = 0;
  double sets = 0;
  double switches = 0;

  /// All bytes.
  [[nodiscard]] constexpr double Times(const GraphSize& bytes) const {
    return candidates * bytes.candidates + sets * bytes.sets + switches * bytes.switches;
  }
};

/// What is measured of graphs in which sets are joined over faces that both have.
struct JoinedGraph {
  GraphSize bytes;
  int common_faces = 0;  ///< over which two sets are joined
  /// Switches over the square of the sets, times that power of the faces.
  double switches = 0;

  /// All bytes of a graph on n faces. @param size  without switches.
  [[nodiscard]] double BytesOf(GraphSize size, double n) const;
};

/// The faces that an estimate counts on: at most so many, drawn from all of them; ascending.
[[nodiscard]] std::vector<FaceIndex> DrawFaces(const object::Object& object, int most,
                                               RandomStream random);

/// How many choices of so many faces there are among n, where `counted` are among m.
[[nodiscard]] double ScaleUp(double counted, int faces, double m, double n);

/// What a planner's graph takes. @param bytes_for  for so many faces.
[[nodiscard]] MemoryNeed NeedOfGraph(const std::string& planner, const object::Object& object,
                                     std::function<double(double)> bytes_for);

/// What is the same in the summary of every graph of grasp sets: all but types and edges.
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
