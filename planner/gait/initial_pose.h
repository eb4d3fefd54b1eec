#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"

namespace regrasp::gait {

/// Draw a rotation uniformly from SO(3): a normalized quaternion with four normal components.
[[nodiscard]] inline Eigen::Matrix3d DrawOrientation(RandomStream& random) {
  Eigen::Quaterniond turn;
  for (int k = 0; k < 4; ++k) turn.coeffs()[k] = random.Normal();
  return turn.normalized().toRotationMatrix();
}

/// Find initial object poses for a task, best first.
/// A pose is good if many fingers reach many contacts throughout the task, the reachable contacts
/// form admissible grasps, and the object is clear of the palm. Draws position and yaw of the
/// upright object. For a turn of more than half a revolution about its vertical, and for a turn of
/// a slender object (kSlender) by more than 100°, half of the draws let the object lie on a side.
/// If a start or goal grasp is given, draws orientations freely and puts one of its contacts at a
/// fingertip.
/// @param memory  contacts of the setup under the same numbers.
/// @returns at most 24 poses of the object in the palm's frame; empty if none is found.
[[nodiscard]] std::vector<Eigen::Isometry3d> FindInitialPoses(const HandSetup& setup,
                                                              const ObjectTask& task,
                                                              const GaitEnds& ends,
                                                              criteria::GraspMemory& memory,
                                                              RandomStream& random);

/// Find idle joint configurations that keep clear of the palm and of the object along a track.
/// Configurations with more clearance, up to 20 mm, and closer to the middle of the joint ranges
/// come first.
/// @returns candidates by finger; nullopt if a finger has none.
[[nodiscard]] std::optional<IdleConfigurations> FindIdleConfigurations(const HandSetup& setup,
                                                                       const PoseTrack& track,
                                                                       RandomStream& random);

}  // namespace regrasp::gait
