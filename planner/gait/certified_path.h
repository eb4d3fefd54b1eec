#pragma once

#include <vector>

#include "planner/gait/hand_scene.h"
#include "planner/gait/keyframe.h"

namespace regrasp::gait {

/// What touches the object, by finger.
using Touching = std::vector<TipContact>;

/// Whether hand and object keep the margin all the way from a keyframe to the next one: certified,
/// at samples so dense that nothing comes nearer between them than the motion's bound allows.
/// Fingers that touch may be in the surface by kTipDepth.
[[nodiscard]] bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
                           const Touching& touching);

/// The same for one finger that moves while all else stands still.
/// @param others  all other fingers, as they stand.
[[nodiscard]] bool IsClear(const HandScene& scene, FingerIndex finger, const Posture& from,
                           const Posture& to, const Eigen::Isometry3d& pose, TipContact tip,
                           const std::vector<PlacedFinger>& others);

}  // namespace regrasp::gait
