#pragma once

#include "planner/plan/plan.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Moves all holding fingers at once along the surface, from one grasp to another, as fingertips
/// that roll: their contacts move and none slips, so friction needs no force to overcome, and the
/// fingers press with balanced forces inside cones of kSlideFriction μ (sim/control/align.h), or of
/// the whole μ where there are none.
///
/// A fingertip is a ball that does not turn. It is moved along with its contact at rest, which is
/// to the object what rolling is: the contacts of the engine know velocities along the surface, and
/// no place on it.
/// @param to_B  the same fingers in the same order; each moves straight inside one face or turns at
///              a point of the border of two.
void RollFingers(ReplayWorld& world, const plan::FingerGrasp& from_B,
                 const plan::FingerGrasp& to_B);

}  // namespace regrasp::sim
