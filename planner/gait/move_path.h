#pragma once

#include <optional>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"

namespace regrasp::gait {

/// Certified keyframes of a move through poses: all holding fingers keep their contacts, the ball's
/// centre one radius above each, the others stay where they are.
///
/// Between keyframes drives go straight; there are so many of them that no tip is off its contact
/// by more than kTipOff half-way.
/// @param from   where tips are at their contacts.
/// @param poses  of the object between, where it goes one after the other.
/// @param to     where tips are at their contacts again.
/// @returns nullopt where a finger can't follow, comes to another branch of its postures, or
///          something comes too near something.
[[nodiscard]] std::optional<std::vector<Keyframe>> FindMove(
    const HandSetup& setup, const Holding& holding, const Keyframe& from,
    const std::vector<Eigen::Isometry3d>& poses, const Keyframe& to);

/// Metres.
inline constexpr double kTipOff = 2e-5;

/// Postures of a finger at one place that differ by less are of one branch, radians.
inline constexpr double kSameBranch = 0.02;

}  // namespace regrasp::gait
