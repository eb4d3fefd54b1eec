#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace regrasp::planning {

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

/// How much of a graph sampling found. Quadruples of faces, as sampling does not tell components of
/// one quadruple apart.
struct SamplingShare {
  std::int64_t quadruples = 0;        ///< of the direct graph
  std::int64_t found_quadruples = 0;  ///< of these
  std::int64_t links = 0;             ///< between quadruples of the direct graph
  std::int64_t found_links = 0;       ///< of these
};

/// The size of a planner's graph, and what was asked for besides.
struct GraphSummary {
  std::string planner;
  std::int64_t faces = 0;  ///< edges of a polygon, contact points of a roadmap
  std::string face_name;   ///< what `faces` counts: "edges"
  std::vector<TypeSummary> types;
  std::vector<std::pair<std::string, std::int64_t>> edges;  ///< by types, as "parallel-parallel"
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
  std::optional<std::int64_t> unclear;  ///< decisions too close to call, where there can be such
  std::optional<SamplingShare> sampling_share;
  int clusters = 0;  ///< of the contact points of a roadmap
  std::optional<QuerySummary> queries;
};

}  // namespace regrasp::planning
