#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
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

/// Target of a fingertip in the palm's frame.
/// It is the centre of the fingertip sphere, and the direction from there to the contact.
struct TipTarget {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards = Eigen::Vector3d::Zero();  ///< unit vector
};

/// Constraints on a joint configuration in addition to the fingertip's position.
struct ConfigurationLimits {
  double from_limits = 0.02;  ///< distance of joints from their limits, radians
  /// Largest angle between pointing direction (Fingertip::axis) and contact, radians.
  /// A finger touches with its end and its pad, not with its back.
  double approach = 1.92;
};

/// Tolerance of the fingertip's position, metres.
inline constexpr double kTipTolerance = 1e-9;

/// Inverse kinematics of one finger.
/// The fingertip's position gives three equations, typically for four independent joints. Among the
/// solutions it selects the one nearest to the middle of the joint ranges, by damped least squares
/// with joint centering as the secondary task (Nakamura and Hanafusa 1986). Iterations start from a
/// table of sampled configurations. A target far from all samples is out of reach without any
/// iteration.
///
/// The result depends on the target only, not on the current configuration. It therefore follows a
/// moving target continuously, except for jumps between solution branches.
class InverseKinematics {
 public:
  /// @param finger  kinematic chain; outlives this object.
  explicit InverseKinematics(const Finger& finger, const ConfigurationLimits& limits = {});

  /// Return the joint configuration of a target.
  /// @returns nullopt if none is found.
  [[nodiscard]] std::optional<JointConfiguration> Solve(const TipTarget& target) const;
  /// Return the configuration of a target on the solution branch of a nearby configuration.
  [[nodiscard]] std::optional<JointConfiguration> SolveFrom(const TipTarget& target,
                                                            const JointConfiguration& start) const;

  /// Return the configuration of a target that is near a start, without joint centering.
  /// Used for paths between two given configurations.
  [[nodiscard]] std::optional<JointConfiguration> SolveNear(const TipTarget& target,
                                                            const JointConfiguration& start) const;

  /// Return whether the fingertip of a sampled configuration is near the target. If not, no inverse
  /// kinematics is computed.
  [[nodiscard]] bool MayReach(const TipTarget& target) const { return NearestSample(target) >= 0; }

  [[nodiscard]] const Finger& finger() const { return finger_; }
  /// Return the middle of the joint ranges.
  [[nodiscard]] const JointConfiguration& middle() const { return middle_; }
  /// Return the fingertip positions of the samples, metres.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& sampled_tips() const { return centres_; }

 private:
  [[nodiscard]] int NearestSample(const TipTarget& target) const;
  [[nodiscard]] int CellOf(const Eigen::Vector3i& cell) const;
  [[nodiscard]] Eigen::Vector3i CellAt(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::optional<JointConfiguration> Iterate(const TipTarget& target,
                                                          const JointConfiguration& start,
                                                          bool towards_middle) const;
  [[nodiscard]] bool Fits(const TipTarget& target, const JointConfiguration& configuration) const;

  const Finger& finger_;
  ConfigurationLimits limits_;
  JointConfiguration lower_, upper_, middle_, range_;
  std::vector<JointConfiguration> samples_;  ///< sorted by cell
  std::vector<double> off_middle_;           ///< costs of distance from the middle, square metres
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Eigen::Vector3d> axes_;
  Eigen::Vector3d corner_;          ///< corner of the grid of cells
  Eigen::Vector3i cells_;           ///< number of cells along each axis
  std::vector<int> first_of_cell_;  ///< first sample of each cell, then their number
};

}  // namespace regrasp::kinematics
