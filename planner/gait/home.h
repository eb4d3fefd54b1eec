#pragma once

#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/hand_setup.h"

namespace regrasp::gait {

/// Poses in the hand to begin a turn in, the best first: where many contacts are within reach of
/// many fingers all along the turn and make grasps, and the object keeps off the palm. The object's
/// own z axis is upright there; its place and its yaw are drawn.
/// @param centre  of the object, in its frame, metres.
/// @param memory  knows the setup's points as contacts under their numbers.
[[nodiscard]] std::vector<Eigen::Isometry3d> FindHomes(const HandSetup& setup,
                                                       const Eigen::Vector3d& centre,
                                                       const Turn& turn,
                                                       criteria::GraspMemory& memory,
                                                       RandomStream& random);

/// Postures out of the way: each finger as far from the object's poses along a track as it can
/// be (no more than some millimetres count), and off the palm.
/// @returns none where a finger has no such posture.
[[nodiscard]] std::optional<Parking> FindParking(const HandSetup& setup, const PoseTrack& track,
                                                 RandomStream& random);

}  // namespace regrasp::gait
