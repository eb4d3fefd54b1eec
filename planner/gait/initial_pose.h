#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"

namespace regrasp::gait {

/// A turn drawn evenly among all: four normal numbers are a direction in four dimensions, which a
/// unit quaternion is.
[[nodiscard]] inline Eigen::Matrix3d DrawTurn(RandomStream& random) {
  Eigen::Quaterniond turn;
  for (int k = 0; k < 4; ++k) turn.coeffs()[k] = random.Normal();
  return turn.normalized().toRotationMatrix();
}

/// Poses in the hand to begin a journey in, the best first: where many contacts are within reach of
/// many fingers all along and make grasps, and the object keeps off the palm. The object's own z
/// axis is upright there, its place and its yaw are drawn; but where a grasp is given any pose may
/// be drawn that brings its contacts to the fingertips.
/// @param memory  knows the setup's points as contacts under their numbers.
[[nodiscard]] std::vector<Eigen::Isometry3d> FindInitialPoses(const HandSetup& setup,
                                                              const ObjectTask& task,
                                                              const GaitEnds& ends,
                                                              criteria::GraspMemory& memory,
                                                              RandomStream& random);

/// Postures out of the way: each finger as far from the object's poses along a track as it can
/// be (no more than some millimetres count), and off the palm.
/// @returns none where a finger has no such posture.
[[nodiscard]] std::optional<IdlePostures> FindIdlePostures(const HandSetup& setup,
                                                           const PoseTrack& track,
                                                           RandomStream& random);

}  // namespace regrasp::gait
