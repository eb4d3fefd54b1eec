#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

/// Most joints that a finger may have.
inline constexpr int kMostJoints = 8;

/// The frames of a finger's joints, in the palm's frame, from the palm to the tip.
using JointFrames = std::vector<Eigen::Isometry3d>;

/// Return the angle of a joint's drive at which the joint has an angle, radians.
[[nodiscard]] inline double DriveAngle(const Joint& joint, double angle) {
  return (angle - joint.coupling_offset) / joint.ratio;
}

/// Return the joint whose angle is that of a drive; the other joints of the drive follow it.
[[nodiscard]] const Joint& LeadingJoint(const Finger& finger, int drive);

/// Angles of the joints of a posture, radians.
[[nodiscard]] std::vector<double> JointAngles(const Finger& finger, const Posture& posture);

[[nodiscard]] JointFrames FramesOf(const Finger& finger, const Posture& posture);

/// The centre of the fingertip's ball in the palm's frame, metres, and how it moves with the
/// drives, metres per radian.
struct TipState {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< Fingertip::axis in the palm's frame
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostJoints> jacobian;
};
[[nodiscard]] TipState TipAt(const Finger& finger, const Posture& posture);

/// A bound on how far a point of the first `after` joints' links moves, metres, where the drives
/// move straight from one posture to another: Σ |Δq| times the farthest that any point of the
/// shape can be from the joint's axis.
/// @param reach  as LinkReach.
[[nodiscard]] double MotionBound(const Finger& finger, const Posture& from, const Posture& to,
                                 int after, const std::vector<double>& reach);

/// By joint up to the one that carries the shape: no point of it is ever farther from the joint's
/// axis than this, whatever the joints after it do, metres.
[[nodiscard]] std::vector<double> LinkReach(const Finger& finger, const LinkShape& shape);

/// An upper bound on the distance of a point that the fingertip touches from the finger's first
/// joint, metres: the sum of the lengths of all links, whatever the joint limits.
[[nodiscard]] double MaximumReach(const Finger& finger);

}  // namespace regrasp::kinematics
