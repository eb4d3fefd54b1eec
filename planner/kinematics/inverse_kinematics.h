#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

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
