#pragma once

#include <vector>

#include "sim/scene/measured.h"

namespace regrasp::sim {

class ReplayWorld;

/// Looks for the largest push in every direction, each from the state of rest that the world is in;
/// afterwards everything but the monitor is as before.
///
/// What the object stands is checked as in a step: it does not move, slip or lose a contact by more
/// than the tolerance. A grasp that resists two pushes resists all in between, so that a bisection
/// finds the limit: to kStressGap of it, or to kLeastStress.
[[nodiscard]] std::vector<DirectionStress> MeasureStress(ReplayWorld& world);

inline constexpr double kStressGap = 0.01;    ///< over the limit
inline constexpr double kLeastStress = 1e-4;  ///< pushes nearer to each other count as one

}  // namespace regrasp::sim
