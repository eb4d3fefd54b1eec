#pragma once

#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"

namespace regrasp::roadmap {

/// Plans on a roadmap of clusters: FindContactChain looks for a sequence, and the contacts of the
/// one that it finds are the contact points of a plain roadmap, which shortens and widens it. A
/// random grasp is drawn from all force-closure grasps of four contact points; a random goal is
/// drawn anew while no sequence leads there.
/// @param request  as Planner::Plan has it.
/// @throws NoGrasp, TimeUp
[[nodiscard]] planning::PlanResult SearchClusters(const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
