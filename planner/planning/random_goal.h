#pragma once

#include <functional>

#include "planner/planning/plan_result.h"

namespace regrasp::planning {

/// A random goal is drawn anew up to so many times while the sequence to it passes grasps that are
/// not as good as asked.
inline constexpr int kGoalDraws = 12;

/// The first plan without a warning of kGoalDraws, or else the first one; that one also where the
/// time is up for others.
/// @param plan  draws a goal and plans to it; the last time one that the start is in a set with.
[[nodiscard]] PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan);

}  // namespace regrasp::planning
