#pragma once

#include "planner/plan/plan.h"
#include "sim/scene/align_script.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Carries out an align as its script says, and says how.
///
/// Imitated: with spare fingers every finger is handed over by switches. A spare one, its support
/// finger, touches on the finger's path, the finger lifts and comes down at its target, the support
/// finger leaves; so every finger ends where the plan wants it.
///
/// Slid: one finger after the other moves along the surface; its force lies on its cone's edge,
/// towards where it goes, as friction wants it, and the others balance it inside cones of
/// kSlideFriction μ. Where no such forces exist either, the finger is dragged along with the best
/// effort, and the monitor decides. An align that has failed ends there. A finger that turns its
/// normal at a border slides too.
///
/// Mixed: some of it imitated, some slid.
AlignMode PerformAlign(ReplayWorld& world, const AlignScript& script_B);

/// What the frame of an align shows: who moved, and along which path.
void TellMoved(ReplayWorld& world, const std::vector<plan::FingerGrasp>& waypoints_B);

inline constexpr double kSlideForce = 0.01;    ///< least force of a sliding finger over the squeeze
inline constexpr double kSlideSpeed = 1.5e-3;  ///< of D in a natural time

}  // namespace regrasp::sim
