#pragma once

#include <functional>

#include "sim/actuation/hand_replay.h"
#include "sim/replay/trials.h"

namespace regrasp::sim {

/// Replays a plan by its hand `trials.count` times in worlds that differ from what the hand
/// believes: friction and mass as in RunTrials; where the object is at first, along and about each
/// axis by a normal deviate (position_noise · D, and that over R in radians); and what each joint's
/// angle is off all along (joint_noise, 0 where left out), which it does not know of.
///
/// Laws: trial k depends on the seed and k alone; without any error every trial is the nominal
/// replay.
/// @param options   of the nominal replay, which passes.
/// @param progress  told after every trial; may be empty.
/// @throws std::invalid_argument  as RunTrials. @throws InputError  as ReplayHand.
[[nodiscard]] TrialSummary RunHandTrials(const kinematics::HandFile& file,
                                         const object::Polyhedron& solid, const plan::Plan& plan,
                                         const HandReplayOptions& options,
                                         const TrialOptions& trials,
                                         const std::function<void(int done)>& progress = {});

}  // namespace regrasp::sim
