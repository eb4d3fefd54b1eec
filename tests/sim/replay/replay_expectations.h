#pragma once

#include <vector>

#include "sim/replay/replay.h"

namespace regrasp::sim {

/// Limit of the motion and slip of a good grasp in a step, over the diameter.
/// It is also the limit of the error of its contact points, and a tenth of the tolerance.
inline constexpr double kGood = 1e-4;

/// Expect that `entries` steps pass, almost without motion.
void ExpectGood(const ReplayResult& result, std::size_t entries);

/// Return true if the object moved, slipped or lost a contact.
[[nodiscard]] bool LosesObject(plan::Reason reason);

/// Expect contact at the planned points in the static grasp of every step.
/// Every finger must exert a positive force there.
void ExpectTouchesAsPlanned(const object::Object& object, const plan::Plan& plan,
                            const ReplayResult& result);

/// Expect that two replays of a plan are bitwise equal: all samples and all measurements.
void ExpectSameBitsTwice(const object::Object& object, const plan::Plan& plan);

}  // namespace regrasp::sim
