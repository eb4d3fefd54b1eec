#pragma once

#include <limits>

#include "planner/polyhedron/plan_polyhedron.h"
#include "planner/roadmap/plan_roadmap.h"

namespace regrasp {

/// Plans in space with the planner that fits: PlanOnPolyhedron where start and goal are concurrent
/// grasps of its graph and it joins them, otherwise PlanOnRoadmap. Random grasps are drawn evenly
/// over the surface. The plan names its planner; `progress` is told why it is not polyhedron.
/// @param memory  bytes that the graph of polyhedron may take; where it would take more, roadmap is
///                taken.
/// @throws as PlanOnRoadmap.
[[nodiscard]] PlanResult PlanSpatial(const Polyhedron& solid, const GraspChoice& start,
                                     const GraspChoice& goal, Spanning spanning,
                                     const RoadmapOptions& options,
                                     double memory = std::numeric_limits<double>::infinity());

}  // namespace regrasp
