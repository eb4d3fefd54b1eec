#pragma once

#include <Eigen/Geometry>

#include "planner/planning/in_hand_task.h"

namespace regrasp::gait {

using planning::Turn;

/// Poses of an object from one to another in equal steps: it turns about one axis through its
/// centre, which goes straight.
class PoseTrack {
 public:
  /// @param start   pose of the object in the palm's frame.
  /// @param centre  in the object's frame, metres.
  /// @param turn    the whole of it.
  /// @param shift   of the centre, in the palm's frame, metres.
  PoseTrack(const Eigen::Isometry3d& start, const Eigen::Vector3d& centre, const Turn& turn,
            const Eigen::Vector3d& shift, int steps)
      : start_(start), centre_(centre), turn_(turn), shift_(shift), steps_(steps) {}

  /// @returns 0 where start and goal are one pose.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const Turn& turn() const { return turn_; }
  [[nodiscard]] const Eigen::Vector3d& shift() const { return shift_; }
  /// @param step  in [0, steps()], whole or not.
  [[nodiscard]] Eigen::Isometry3d PoseAt(double step) const {
    const double share = steps_ == 0 ? 0 : step / steps_;
    Eigen::Isometry3d pose = start_;
    pose.linear() =
        start_.linear() * Eigen::AngleAxisd(share * turn_.angle, turn_.axis).toRotationMatrix();
    pose.translation() = start_ * centre_ + share * shift_ - pose.linear() * centre_;
    return pose;
  }

  /// From the same start the other way.
  [[nodiscard]] PoseTrack Backwards() const {
    return {start_, centre_, {turn_.axis, -turn_.angle}, -shift_, steps_};
  }

  /// The same poses from the end to the start, but for rounding.
  [[nodiscard]] PoseTrack Reversed() const {
    if (steps_ == 0) return *this;
    return {PoseAt(steps_), centre_, {turn_.axis, -turn_.angle}, -shift_, steps_};
  }

 private:
  Eigen::Isometry3d start_;
  Eigen::Vector3d centre_;
  Turn turn_;
  Eigen::Vector3d shift_;
  int steps_;
};

}  // namespace regrasp::gait
