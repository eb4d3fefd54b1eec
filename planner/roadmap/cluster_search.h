#pragma once

#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"

namespace regrasp::roadmap {

/// Plan a sequence on a roadmap of clusters.
/// FindContactChain finds a sequence. Its contacts are the contact points of a roadmap without
/// clusters, which then shortens the sequence and increases its margin. Random grasps are drawn
/// from all force-closure grasps of four contact points. A random goal is drawn again until there
/// is a sequence to it.
/// @param request  as Planner::Plan.
/// @throws NoGrasp, TimeUp  as SearchContactPoints.
[[nodiscard]] planning::PlanResult SearchClusters(const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
