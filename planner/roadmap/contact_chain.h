#pragma once

#include <cstdint>
#include <vector>

#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/grasp_tree.h"
#include "planner/roadmap/local_planners.h"

namespace regrasp::roadmap {

/// Result of a query on a clustered roadmap.
struct ContactChain {
  enum class By {
    kNothing,
    kRoadmap,     ///< both ends are linked to the roadmap and connected in it
    kSubsets,     ///< last resort: grasps of the contacts of both ends
    kLastResort,  ///< last resort: grasps of all contact points
  };
  By by = By::kNothing;
  std::vector<Quadruple> grasps;  ///< from start to goal, both included; empty if none
  RoadmapLink start_link = RoadmapLink::kNone;
  RoadmapLink goal_link = RoadmapLink::kNone;
  /// Whether a failed last resort searched one side completely.
  /// Then no sequence exists over these contact points.
  /// The sizes are the numbers of grasps reached from both sides.
  bool exhausted = false;
  std::size_t start_size = 0;
  std::size_t goal_size = 0;
};

/// Find a chain of grasps in which consecutive grasps differ in one contact.
/// Local planners connect both ends to the roadmap of representatives, which is then searched. The
/// contacts of an end that algorithms 1 and 2 do not link are added to the representatives (Phoka
/// 2010, 6.2.4).
///
/// If that fails and `last_resort` is set, the grasps of both ends' contacts are searched, at most
/// 70. Then the grasps of all contact points are searched, best first from both ends.
/// @param clusters  clusters of the roadmap, with the contacts of start and goal.
/// @param oracle    evaluator of the contacts in `clusters`; admits both ends.
[[nodiscard]] ContactChain FindContactChain(const ClusteredRoadmap& roadmap,
                                            const ContactClusters& clusters, GraspOracle& oracle,
                                            const Quadruple& start, const Quadruple& goal,
                                            bool last_resort);

/// Largest number of replacements that the last resort evaluates.
inline constexpr std::int64_t kMostLastResortSteps = 5'000'000;

}  // namespace regrasp::roadmap
