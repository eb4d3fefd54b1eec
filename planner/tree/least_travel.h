#pragma once

#include <optional>
#include <vector>

#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// Joins two grasps over grasps of a few contacts, by switches and aligns, with the least travel
/// (TravelOf, path_plan.h): Dijkstra's search (1959), in which a subset is tested when its turn
/// comes and the aligns of a path are proved when it is found.
/// @param contacts    those of the ends included, at most kMostSubsetContacts.
/// @param most_steps  no path has more.
/// @param bound       no path is looked for that is not shorter than this.
/// @returns nullopt where there is no such path.
[[nodiscard]] std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                                         const criteria::ContactSet& to,
                                                         const std::vector<int>& contacts,
                                                         int most_steps, double bound,
                                                         SearchSpace& space);

}  // namespace regrasp::tree
