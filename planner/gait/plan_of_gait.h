#pragma once

#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/request.h"
#include "planner/plan/plan.h"

namespace regrasp::gait {

/// The same gait with one move where several follow each other, each straight from pose to pose
/// where that is free, and none that ends where it begins; but where contacts roll
/// (HandSetup::rolled_on) the object stays on the way on which they were followed.
///
/// Laws: the same keyframes first and last, the same changes in the same order, and no more
/// stretches; certified like the gait.
[[nodiscard]] Gait MergeMoves(const HandSetup& setup, const Gait& gait);

/// The plan that a gait is, all but the object's file and digest: finger numbers are those of the
/// hand, a placed and the next released finger are one switch.
[[nodiscard]] plan::Plan PlanOf(const Gait& gait, const GaitRequest& request,
                                const std::vector<grasp::Contact>& contacts);

/// Of the first steps of a gait's plan how many of its stretches are no moves.
[[nodiscard]] int CountChanges(const Gait& gait, int steps);

}  // namespace regrasp::gait
