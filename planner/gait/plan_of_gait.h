#pragma once

#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/request.h"
#include "planner/plan/plan.h"

namespace regrasp::gait {

/// Merge consecutive in-hand motions of a gait into one.
/// The merged motion is straight if that is collision-free, and is dropped if it ends where it
/// begins. If fingertips roll (HandSetup::rolled_on), the object keeps the path along which rolling
/// was computed.
/// Laws: same first and last keyframe, same contact changes in the same order, no more segments;
/// certified like the gait.
[[nodiscard]] Gait MergeMoves(const HandSetup& setup, const Gait& gait);

/// Convert a gait into a plan without the object's file and digest.
/// Finger numbers are those of the hand. A placed finger and the finger released next form one
/// finger switch.
/// @param contacts  contacts by number, in object units.
[[nodiscard]] plan::Plan PlanOf(const Gait& gait, const GaitRequest& request,
                                const std::vector<grasp::Contact>& contacts);

/// Return the number of contact changes within the first `steps` plan steps of a gait.
[[nodiscard]] int CountChanges(const Gait& gait, int steps);

}  // namespace regrasp::gait
