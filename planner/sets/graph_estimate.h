#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/object/object.h"
#include "planner/planning/planner.h"

namespace regrasp::sets {

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
