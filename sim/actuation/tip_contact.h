#pragma once

#include <array>

namespace regrasp::sim {

// How hard tips and object touch in MuJoCo, in the replay by a hand and in its exported scene.

/// In which a contact comes back, seconds (solref): five steps of the replay; damped critically.
inline constexpr double kTipContactTime = 5e-3;
/// Impedances, the depth over which the one becomes the other, metres, and the shape (solimp).
inline constexpr std::array<double, 5> kTipImpedance = {0.95, 0.99, 0.0001, 0.5, 2};

}  // namespace regrasp::sim
