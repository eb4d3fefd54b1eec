#pragma once

#include <vector>

#include "sim/replay/replay.h"

namespace regrasp::sim {

/// Limit of the motion and slip of a good grasp in a step, and of the error of its contact points,
/// over the diameter: a tenth of the tolerance.
inline constexpr double kGood = 1e-4;

/// Expect that `entries` steps pass, almost without motion.
void ExpectGood(const ReplayResult& result, std::size_t entries);

/// Return true if the object moved, slipped or lost a contact.
[[nodiscard]] bool LosesObject(plan::Reason reason);

/// Expect that in the static grasp of every step, every finger touches the object at its planned
/// point with a positive force.
void ExpectTouchesAsPlanned(const object::Object& object, const plan::Plan& plan,
                            const ReplayResult& result);

/// Expect that two replays of a plan are bitwise equal: all samples and all measurements.
void ExpectSameBitsTwice(const object::Object& object, const plan::Plan& plan);

}  // namespace regrasp::sim
