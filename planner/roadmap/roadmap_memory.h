#pragma once

#include "planner/base/memory.h"
#include "planner/planning/plan_request.h"

namespace regrasp::roadmap {

/// What a roadmap takes at most while it is built and searched, within a factor of two: the larger
/// of the two that its options ask for, the clustering of its contact points, which goes with the
/// square of their number, and its force-closure grasps, which go with the fourth power of the
/// number of contact points or representatives and not with the size of the mesh.
///
/// The share of force-closure grasps is that of grasps drawn evenly over the surface. What a grasp
/// takes was measured: at the limits, kMaxRoadmapContacts and kMostClusters, 0.7 to 4 GB, and 0.5
/// GB for kMaxClusteredContacts.
///
/// Law: the same solid and options give the same number.
[[nodiscard]] MemoryNeed EstimateRoadmap(const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
