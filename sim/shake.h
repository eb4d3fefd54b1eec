#pragma once

#include "sim/stage.h"

namespace regrasp {

/// Pushes and turns the object at rest along ± every axis, one after the other (in the plane along
/// ± x and y and about ± z): a force of
/// shake · squeeze, then a torque of that over R, on top of the weight. The fingers answer with
/// forces planned for each. The stage's judge measures; afterwards everything is as before.
void Shake(Stage& stage);

inline constexpr int kShakeRampSteps = 30;  ///< a finger's servo settles in about 5 steps
inline constexpr int kShakeHoldSteps = 20;

}  // namespace regrasp
