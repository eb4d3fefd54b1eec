#pragma once

#include <limits>

#include "planner/registry/plan_planar.h"
#include "planner/sets/polygon/grasp_set.h"
#include "planner/tree/plan_general.h"

namespace regrasp {

struct AutoPlanOptions {
  GeneralPlanOptions general;  ///< friction, seed, quality and progress count for all
  Spanning spanning = Spanning::kAdaptive;
  SwitchObjective contour_aim = SwitchObjective::kRoom;
  /// Bytes that the graph of an exact planner may take; where it would take more, that planner is
  /// not asked.
  double memory = std::numeric_limits<double>::infinity();
};

/// Plans with the planner that fits: an exact one (polyhedron in space; contour, then polygon in
/// the plane) where it joins start and goal by good grasps, otherwise PlanGeneral, and where that
/// fails what the exact one said of weaker grasps. A note says why it was not an exact one. Exact
/// planners are asked only on bodies of a size that they answer for soon, for grasps of a number of
/// contacts that they know, and where the aim is Objective::kSteps.
///
/// Where there is a deadline the exact ones have half of the time until then.
///
/// Random grasps are drawn evenly over the surface, whatever the planner.
/// @throws as PlanGeneral.
[[nodiscard]] PlanResult PlanAuto(const Object& object, const GraspChoice& start,
                                  const GraspChoice& goal, const AutoPlanOptions& options);

}  // namespace regrasp
