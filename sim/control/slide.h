#pragma once

#include "planner/plan/plan.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Moves a holding finger along the surface, straight inside one face, or rolls it about a point of
/// the border between two faces, while the others balance it.
///
/// The finger's force lies on the edge of its cone towards where it goes, as friction wants it. Its
/// size is the least that leaves the others a good margin inside cones of kSlideFriction μ
/// (sim/control/align.h); where none leaves any, the one that comes closest.
void SlideFinger(ReplayWorld& world, FingerIndex finger, const grasp::Contact& from_B,
                 const grasp::Contact& to_B);

/// How well the others can balance the finger at both ends of its slide: the smaller margin of
/// their forces (GraspForces::margin); not positive where they cannot.
[[nodiscard]] double SlideMargin(const ReplayWorld& world, FingerIndex finger,
                                 const grasp::Contact& from_B, const grasp::Contact& to_B);

}  // namespace regrasp::sim
