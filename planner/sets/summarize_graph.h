#pragma once

#include <string>

#include "planner/object/object.h"
#include "planner/planning/graph_summary.h"

namespace regrasp::sets {

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
