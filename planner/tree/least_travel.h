#pragma once

#include <optional>
#include <vector>

#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// Joins two grasps over grasps of a few contacts, by switches and aligns, with the least travel
/// (TravelOf, path_plan.h): Dijkstra's search, in which a subset is tested when its turn comes and
/// the aligns of a way are proved when it is found.
/// @param contacts    those of the ends included, at most kMostSubsetContacts.
/// @param most_steps  no way has more.
/// @param bound       no way is looked for that is not shorter than this.
/// @returns nullopt where there is no such way.
[[nodiscard]] std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                                         const criteria::ContactSet& to,
                                                         const std::vector<int>& contacts,
                                                         int most_steps, double bound,
                                                         SearchSpace& space);

}  // namespace regrasp::tree
