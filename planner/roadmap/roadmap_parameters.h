#pragma once

#include <optional>
#include <string>
#include <vector>

namespace regrasp::roadmap {

// Options of the planner `roadmap`, as users write them.
inline constexpr char kContactsOption[] = "--planner points";
inline constexpr char kClustersOption[] = "--planner clusters";
inline constexpr char kNoLastResortOption[] = "--planner fallback=no";
inline constexpr char kQueriesOption[] = "--planner queries";

/// Parameters of the planner `roadmap` in PlanRequest::parameters.
struct RoadmapParameters {
  /// Number of contact points. Default: 60, or 1000 if there are clusters.
  std::optional<int> contact_points = {};
  /// Number of clusters of the contact points; 0: no clusters. Default: 50 if the object has more
  /// than 200 faces or there are more than 200 contact points, otherwise 0.
  std::optional<int> clusters = {};
  /// Whether to search the grasps of all contact points if the representatives of the clusters do
  /// not connect start and goal.
  bool last_resort = true;
  int queries = 0;  ///< number of random queries that SummarizeGraph answers

  [[nodiscard]] std::vector<std::string> Options() const {
    std::vector<std::string> options;
    if (contact_points) options.emplace_back(kContactsOption);
    if (clusters) options.emplace_back(kClustersOption);
    if (!last_resort) options.emplace_back(kNoLastResortOption);
    if (queries > 0) options.emplace_back(kQueriesOption);
    return options;
  }
};

}  // namespace regrasp::roadmap
