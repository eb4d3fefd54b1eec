#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/roadmap/plan_roadmap.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polyhedron/sampled_graph.h"

namespace regrasp {

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
  std::optional<SamplingShare> sampling_share;
  int clusters = 0;  ///< of the contact points of a roadmap
  std::optional<QuerySummary> queries;
};

/// The switching graphs of the planners.
[[nodiscard]] GraphSummary SummarizePolygon(const Polygon& polygon, double half_angle,
                                            Spanning spanning);
[[nodiscard]] GraphSummary SummarizeContour(const Polygon& polygon, double half_angle);
/// @param sampling  random focus points in place of the direct computation; 0: none.
[[nodiscard]] GraphSummary SummarizePolyhedron(const Polyhedron& solid, double half_angle,
                                               Spanning spanning, int sampling, std::uint64_t seed);
/// @param queries  random queries to answer, on a roadmap of clusters.
[[nodiscard]] GraphSummary SummarizeRoadmap(const Polyhedron& solid, const RoadmapOptions& options,
                                            int queries);

}  // namespace regrasp
