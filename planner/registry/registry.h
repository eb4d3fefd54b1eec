#pragma once

#include <string>
#include <vector>

#include "planner/planning/planner.h"

namespace regrasp {

/// All planners: `general` first, then those that are complete over the grasps that they know.
[[nodiscard]] const std::vector<const Planner*>& AllPlanners();

/// Their names and "auto", in the order of AllPlanners, for messages: "auto, general, contour …".
[[nodiscard]] std::string PlannerNames();

/// @returns nullptr where no planner has that name.
[[nodiscard]] const Planner* FindPlanner(const std::string& name);

}  // namespace regrasp
