#pragma once

#include <Eigen/Geometry>

namespace regrasp::gait {

/// Poses of an object from one to another in equal steps: it turns about one axis through its
/// centre, which stays.
class PoseTrack {
 public:
  /// @param start   pose of the object in the palm's frame.
  /// @param centre  in the object's frame, metres.
  /// @param axis    of length 1, in the object's frame.
  /// @param angle   of the whole turn, radians.
  /// @param steps   > 0.
  PoseTrack(const Eigen::Isometry3d& start, const Eigen::Vector3d& centre,
            const Eigen::Vector3d& axis, double angle, int steps)
      : start_(start), centre_(centre), axis_(axis), angle_(angle), steps_(steps) {}

  [[nodiscard]] int steps() const { return steps_; }
  /// @param step  in [0, steps()], whole or not.
  [[nodiscard]] Eigen::Isometry3d PoseAt(double step) const {
    const double share = step / steps_;
    Eigen::Isometry3d pose = start_;
    pose.linear() = start_.linear() * Eigen::AngleAxisd(share * angle_, axis_).toRotationMatrix();
    pose.translation() = start_ * centre_ - pose.linear() * centre_;
    return pose;
  }

 private:
  Eigen::Isometry3d start_;
  Eigen::Vector3d centre_;
  Eigen::Vector3d axis_;
  double angle_;
  int steps_;
};

}  // namespace regrasp::gait
