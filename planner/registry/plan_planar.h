#pragma once

#include "planner/sets/contour/plan_contour.h"
#include "planner/sets/polygon/plan_polygon.h"

namespace regrasp {

struct PlanarPlanOptions {
  /// Friction, seed, quality, progress and what limits the work count for both.
  PolygonPlanOptions polygon;
  SwitchObjective aim = SwitchObjective::kRoom;  ///< of the planner contour
};

/// Plans in the plane with the planner that fits: PlanOnContour where start and goal are 2-finger
/// grasps and it joins them, otherwise PlanOnPolygon. Random grasps are drawn evenly over the
/// boundary, of two contacts or three by the seed. The plan names its planner.
/// @throws as PlanOnPolygon.
[[nodiscard]] PlanResult PlanPlanar(const Polygon& polygon, const GraspChoice& start,
                                    const GraspChoice& goal, const PlanarPlanOptions& options);

}  // namespace regrasp
