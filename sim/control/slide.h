#pragma once

#include "planner/plan/plan.h"
#include "sim/scene/align_script.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Moves all holding fingers at once along the surface, from one grasp to another, as fingertips
/// that roll: their contacts move and none slips, so friction needs no force to overcome, and the
/// fingers press with balanced forces inside cones of kSlideFriction μ (sim/control/slide.h), or of
/// the whole μ where there are none.
///
/// A fingertip is a ball that does not turn. It is moved along with its contact at rest, which is
/// to the object what rolling is: the contacts of the engine know velocities along the surface, and
/// no place on it.
/// @param to_B  the same fingers in the same order; each moves straight inside one face or turns at
///              a point of the border of two.
void RollFingers(ReplayWorld& world, const plan::FingerGrasp& from_B,
                 const plan::FingerGrasp& to_B);

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

/// Moves a holding finger along the surface, straight inside one face, or rolls it about a point of
/// the border between two faces, while the others balance it.
///
/// The finger's force lies on the edge of its cone towards where it goes, as friction wants it. Its
/// size is the least that leaves the others a good margin inside cones of kSlideFriction μ
/// (sim/control/slide.h); where none leaves any, the one that comes closest.
void SlideFinger(ReplayWorld& world, FingerIndex finger, const grasp::Contact& from_B,
                 const grasp::Contact& to_B);

/// How well the others can balance the finger at both ends of its slide: the smaller margin of
/// their forces (GraspForces::margin); not positive where they cannot.
[[nodiscard]] double SlideMargin(const ReplayWorld& world, FingerIndex finger,
                                 const grasp::Contact& from_B, const grasp::Contact& to_B);

}  // namespace regrasp::sim
