#pragma once

#include <vector>

#include "sim/replay/replay.h"

namespace regrasp::sim {

/// What a good grasp may move or slide in a step, and how far off a finger may touch, over the
/// diameter: a tenth of the tolerance.
inline constexpr double kGood = 1e-4;

/// Expects that so many entries pass, with next to no motion.
void ExpectGood(const ReplayResult& result, std::size_t entries);

/// The object moved, slipped or lost a contact.
[[nodiscard]] bool LosesObject(plan::Reason reason);

/// Expects that at rest, in every entry of the replay, every finger touches where it was planned,
/// and presses.
void ExpectTouchesAsPlanned(const object::Object& object, const plan::Plan& plan,
                            const ReplayResult& result);

/// Expects that two replays of a plan are the same bits: all samples, and what is measured.
void ExpectSameBitsTwice(const object::Object& object, const plan::Plan& plan);

}  // namespace regrasp::sim
