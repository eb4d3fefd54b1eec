#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

/// Largest number of joints of a finger.
inline constexpr int kMostJoints = 8;

/// Poses of the joint frames of a finger in the palm's frame, from the palm to the fingertip.
using JointFrames = std::vector<Eigen::Isometry3d>;

/// Return the angle of the independent joint at which a joint has a given angle, radians.
[[nodiscard]] inline double DriveAngle(const Joint& joint, double angle) {
  return (angle - joint.coupling_offset) / joint.ratio;
}

/// Return an independent joint of a finger; the other joints with this `drive` follow it.
[[nodiscard]] const Joint& LeadingJoint(const Finger& finger, int drive);

/// Return the angles of all joints, coupled ones included, radians.
[[nodiscard]] std::vector<double> JointAngles(const Finger& finger,
                                              const JointConfiguration& configuration);

/// Return the joint configuration in which the independent joints have these angles.
/// @param angles  angles of all joints, as JointAngles returns them, radians.
[[nodiscard]] JointConfiguration ConfigurationAt(const Finger& finger,
                                                 const std::vector<double>& angles);

[[nodiscard]] JointFrames FramesOf(const Finger& finger, const JointConfiguration& configuration);

/// Position of a fingertip and its Jacobian.
/// The position is the centre of the fingertip sphere in the palm's frame, metres. The Jacobian is
/// with respect to the independent joints, metres per radian.
struct TipState {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< Fingertip::axis in the palm's frame
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostJoints> jacobian;
};
[[nodiscard]] TipState TipAt(const Finger& finger, const JointConfiguration& configuration);

/// Return an upper bound of the motion of any point of a link, metres.
/// The finger moves straight from one joint configuration to another.
/// The bound is Σ |Δq| times the largest distance of a point of the shape from the joint's axis.
/// @param after  number of joints that move the link.
/// @param reach  result of LinkReach.
[[nodiscard]] double MotionBound(const Finger& finger, const JointConfiguration& from,
                                 const JointConfiguration& to, int after,
                                 const std::vector<double>& reach);

/// Return the reach of a link by joint, metres.
/// It is the largest distance of the shape's points from the joint's axis in any configuration, for
/// each joint that moves the shape.
[[nodiscard]] std::vector<double> LinkReach(const Finger& finger, const LinkShape& shape);

/// Return an upper bound of the distance of contacts from a finger's first joint, metres.
/// It is the sum of the lengths of all links and ignores joint limits.
[[nodiscard]] double MaximumReach(const Finger& finger);

}  // namespace regrasp::kinematics
