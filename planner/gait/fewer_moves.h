#pragma once

#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"

namespace regrasp::gait {

/// The same gait with one move where several follow each other, each straight from pose to pose
/// where that is free, and none that ends where it begins; but where contacts roll
/// (HandSetup::rolled_on) the object stays on the way on which they were followed.
///
/// Laws: the same keyframes first and last, the same changes in the same order, and no more
/// stretches; certified like the gait.
[[nodiscard]] Gait WithFewerMoves(const HandSetup& setup, const Gait& gait);

}  // namespace regrasp::gait
