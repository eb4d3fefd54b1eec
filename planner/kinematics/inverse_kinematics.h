#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

/// Where a fingertip shall be: the centre of its ball, and the direction from there to the contact,
/// in the palm's frame.
struct TipTarget {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards = Eigen::Vector3d::Zero();  ///< of length 1
};

/// What is asked of a posture beside the place of its tip.
struct PostureLimits {
  double from_limits = 0.02;  ///< radians that drives keep from their limits
  /// Largest angle between where the finger points (Fingertip::axis) and the contact: a finger
  /// touches with its end and its pad, and not with what is behind them. Radians.
  double approach = 1.92;
};

/// Tips are this near to their targets, metres.
inline constexpr double kTipTolerance = 1e-9;

/// Inverse kinematics of one finger: a tip's place are three equations for, mostly, four drives.
/// Of all postures that have the tip there it takes the one nearest to the middle of the finger's
/// range, by damped least squares with the middle as the second task (Nakamura and Hanafusa 1986).
/// Starting places come from a table of where sampled postures have the tip; a target far from all
/// of them is out of reach at once.
///
/// The answer depends on the target alone, not on where the finger was, and so follows a target
/// that moves; except where it jumps from one branch of postures to another one.
class InverseKinematics {
 public:
  /// @param finger  outlives this object.
  explicit InverseKinematics(const Finger& finger, const PostureLimits& limits = {});

  /// @returns nullopt where none was found.
  [[nodiscard]] std::optional<Posture> Solve(const TipTarget& target) const;
  /// From a posture near by, with its branch kept.
  [[nodiscard]] std::optional<Posture> SolveFrom(const TipTarget& target,
                                                 const Posture& start) const;

  /// The posture with its tip at the target that is near the start, wherever the middle is: for
  /// paths between two postures that are given.
  [[nodiscard]] std::optional<Posture> SolveNear(const TipTarget& target,
                                                 const Posture& start) const;

  /// Whether a sampled posture has its tip near the target: no inverse kinematics is tried where
  /// this is false.
  [[nodiscard]] bool MayReach(const TipTarget& target) const { return NearestSample(target) >= 0; }

  [[nodiscard]] const Finger& finger() const { return finger_; }
  /// The middle of the finger's range.
  [[nodiscard]] const Posture& middle() const { return middle_; }
  /// The tips of the sampled postures, metres.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& sampled_tips() const { return centres_; }

 private:
  [[nodiscard]] int NearestSample(const TipTarget& target) const;
  [[nodiscard]] int CellOf(const Eigen::Vector3i& cell) const;
  [[nodiscard]] Eigen::Vector3i CellAt(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::optional<Posture> Iterate(const TipTarget& target, const Posture& start,
                                               bool towards_middle) const;
  [[nodiscard]] bool Fits(const TipTarget& target, const Posture& posture) const;

  const Finger& finger_;
  PostureLimits limits_;
  Posture lower_, upper_, middle_, range_;
  std::vector<Posture> samples_;    ///< by cell
  std::vector<double> off_middle_;  ///< what they cost for being off the middle
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Eigen::Vector3d> axes_;
  Eigen::Vector3d corner_;          ///< of the cells
  Eigen::Vector3i cells_;           ///< along each axis
  std::vector<int> first_of_cell_;  ///< and their number at the end
};

}  // namespace regrasp::kinematics
