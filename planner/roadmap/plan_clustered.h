#pragma once

#include "planner/roadmap/plan_roadmap.h"

namespace regrasp {

/// PlanOnRoadmap with `options.clusters` > 0. A random grasp is drawn from all force-closure grasps
/// of four contact points; a random goal is drawn anew while no sequence leads there.
[[nodiscard]] RoadmapPlanResult PlanOnClusters(const Polyhedron& solid, const GraspChoice& start,
                                               const GraspChoice& goal,
                                               const RoadmapOptions& options);

}  // namespace regrasp
