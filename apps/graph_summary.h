#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/planning/plan_request.h"
#include "planner/sets/polyhedron/sampled_graph.h"

namespace regrasp::apps {

/// How many grasps of one type a graph has.
struct TypeSummary {
  std::string name;
  std::int64_t candidates = 0;
  std::int64_t combinations = 0;
  std::int64_t vertices = 0;
  std::int64_t components = 0;  ///< of the graph, were there only this type
};

/// Random queries over a roadmap, and the times they took.
struct QuerySummary {
  int count = 0;
  int connected = 0;
  double shortest_seconds = 0;
  double longest_seconds = 0;
  double mean_seconds = 0;
};

/// What is known of a graph when it is built.
struct GraphSummary {
  std::string planner;
  std::int64_t faces = 0;  ///< edges of a polygon, contact points of a roadmap
  std::vector<TypeSummary> types;
  std::vector<std::pair<std::string, std::int64_t>> edges;  ///< by types, as "parallel-parallel"
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
  std::int64_t unclear = 0;  ///< decisions too close to call
  std::optional<polyhedron::SamplingShare> sampling_share;
  int clusters = 0;  ///< of the contact points of a roadmap
  std::optional<QuerySummary> queries;
};

/// What else is asked of a graph.
struct GraphTasks {
  int sampling =
      0;            ///< polyhedron: random focus points in place of the direct computation; 0: none
  int queries = 0;  ///< roadmap of clusters: random queries to answer
};

/// Builds the switching graph of a planner.
/// @param planner  "polygon", "contour", "polyhedron" or "roadmap", which serves the object.
[[nodiscard]] GraphSummary SummarizeGraph(const std::string& planner,
                                          const planning::PlanRequest& request,
                                          const GraphTasks& tasks);

}  // namespace regrasp::apps
