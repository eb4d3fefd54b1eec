#pragma once

#include <cstdint>
#include <vector>

#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/grasp_tree.h"
#include "planner/roadmap/local_planners.h"

namespace regrasp::roadmap {

/// How a query over a clustered roadmap went.
struct ContactChain {
  enum class By {
    kNothing,
    kRoadmap,     ///< both ends linked to the roadmap and joined in it
    kSubsets,     ///< last resort: grasps of the contacts of the two ends
    kLastResort,  ///< last resort: grasps of all contact points
  };
  By by = By::kNothing;
  std::vector<Quadruple> grasps;  ///< from start to goal, both included; empty where there is none
  RoadmapLink start_link = RoadmapLink::kNone;
  RoadmapLink goal_link = RoadmapLink::kNone;
  /// Where nothing joined them and the last resort was tried: whether all that one side reaches was
  /// seen, so that no sequence exists over these contact points; and what either side reached.
  bool exhausted = false;
  std::size_t start_size = 0;
  std::size_t goal_size = 0;
};

/// Looks for a chain of grasps, each differing from the one before by one contact: by the local
/// planners from both ends to the roadmap of representatives and a search in it, with the contacts
/// of an end that the algorithms 1 and 2 don't link among the representatives (Phoka 2010, 6.2.4).
///
/// With `last_resort`, where that fails: the at most 70 grasps of the two ends' contacts, then the
/// grasps of all contact points, best first from both ends.
/// @param clusters  those of the roadmap, with the contacts of start and goal.
/// @param oracle    of their contacts; both must fit.
[[nodiscard]] ContactChain FindContactChain(const ClusteredRoadmap& roadmap,
                                            const ContactClusters& clusters, GraspOracle& oracle,
                                            const Quadruple& start, const Quadruple& goal,
                                            bool last_resort);

/// Replacements that the last resort looks at before it gives up.
inline constexpr std::int64_t kMostLastResortSteps = 5'000'000;

}  // namespace regrasp::roadmap
