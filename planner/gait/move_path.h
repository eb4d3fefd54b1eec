#pragma once

#include <optional>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"

namespace regrasp::gait {

/// Certified keyframes of a short move, both ends among them: all holding fingers keep their
/// contacts, the ball's centre one radius above each, the others stay where they are.
///
/// Between keyframes drives go straight; there are so many of them that no tip is off its contact
/// by more than kTipOff half-way.
/// @param from, to  with tips at their contacts.
/// @returns nullopt where a finger can't follow, or something comes too near something.
[[nodiscard]] std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup,
                                                            const Holding& holding,
                                                            const Keyframe& from,
                                                            const Keyframe& to);

/// Metres.
inline constexpr double kTipOff = 2e-5;

}  // namespace regrasp::gait
