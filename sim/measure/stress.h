#pragma once

#include <vector>

#include "sim/measure/push.h"

namespace regrasp::sim {

class ReplayWorld;

/// The largest push that a grasp at rest resists in one direction, over the squeeze (a torque also
/// over R), on top of the weight, its forces adapted to the push.
struct DirectionStress {
  Push push;
  /// The largest push that the object was seen to stand in the replay, found by bisection; 0 where
  /// not even the least was.
  double replay = 0;
  /// The largest push that forces inside the cones with the same squeeze balance, at the contacts
  /// as planned (planner/grasp/largest_load.h); 0 where they do not even carry the weight.
  double analysis = 0;
};

/// Looks for the largest push in every direction, each from the state of rest that the world is in;
/// afterwards everything but the monitor is as before.
///
/// What the object stands is judged as in a step: it does not move, slip or lose a contact by more
/// than the tolerance. A grasp that resists two pushes resists all in between, so that a bisection
/// finds the limit: to kStressGap of it, or to kLeastStress.
[[nodiscard]] std::vector<DirectionStress> MeasureStress(ReplayWorld& world);

inline constexpr double kStressGap = 0.01;    ///< over the limit
inline constexpr double kLeastStress = 1e-4;  ///< pushes nearer to each other count as one

}  // namespace regrasp::sim
