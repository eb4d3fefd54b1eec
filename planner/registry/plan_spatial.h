#pragma once

#include "planner/roadmap/plan_roadmap.h"
#include "planner/sets/polyhedron/plan_polyhedron.h"

namespace regrasp {

/// Plans in space with the planner that fits: PlanOnPolyhedron where start and goal are concurrent
/// grasps of its graph and it joins them, otherwise PlanOnRoadmap. Random grasps are drawn evenly
/// over the surface. The plan names its planner; `progress` is told why it is not polyhedron.
/// Where there is a deadline polyhedron has half of the time until then.
/// @param options  of both; where the graph of polyhedron would take more than its memory, roadmap
///                 is taken.
/// @throws as PlanOnRoadmap.
[[nodiscard]] PlanResult PlanSpatial(const Polyhedron& solid, const GraspChoice& start,
                                     const GraspChoice& goal, Spanning spanning,
                                     const RoadmapOptions& options);

}  // namespace regrasp
