#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace regrasp::report {

/// The motion of the object since the start of a plan for a hand, relative to the planned motion.
///
/// The motion is the angle about the axis of the planned rotation (the twist of the orientation
/// about this axis), which can exceed half a turn.
/// If the plan does not rotate the object, it is the distance from the initial position.
class ObjectProgress {
 public:
  /// Create the progress at the start of a plan.
  /// @param planned  poses along the plan in the world frame, at least one. Between two of them the
  ///                 object rotates by less than half a turn.
  explicit ObjectProgress(const std::vector<Eigen::Isometry3d>& planned);

  /// Return the angle of the planned rotation, radians; nullopt if the plan does not rotate the
  /// object.
  [[nodiscard]] std::optional<double> goal_angle() const { return goal_angle_; }

  /// Follow the object to its next pose. Between two poses it must rotate by less than half a turn.
  /// @param X_WO  pose in the world frame.
  void Follow(const Eigen::Isometry3d& X_WO);
  /// Return the angle up to now, radians.
  [[nodiscard]] double angle() const { return angle_; }

  /// Return the motion up to now and the planned one, for example "36.7° of 90°" or "12 mm of
  /// 30 mm"; empty if the plan does not move the object.
  [[nodiscard]] std::string Text() const;

 private:
  /// Return the angle of a pose that is nearest to `near`, radians.
  [[nodiscard]] double AngleOf(const Eigen::Isometry3d& X_WO, double near) const;

  std::optional<double> goal_angle_;
  double goal_distance_m_ = 0;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  ///< axis of the planned rotation
  Eigen::Isometry3d first_, last_;                   ///< first and last pose up to now
  double angle_ = 0;
};

}  // namespace regrasp::report
