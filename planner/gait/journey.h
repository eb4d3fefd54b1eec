#pragma once

#include <optional>

#include "planner/gait/pose_track.h"

namespace regrasp::gait {

/// What an object is to do, wherever it begins: turn about its centre, or go to a pose.
class Journey {
 public:
  /// @param centre  of the object, in its frame, metres.
  /// @param goal    in the palm's frame; instead of the turn.
  Journey(const Eigen::Vector3d& centre, const Turn& turn,
          const std::optional<Eigen::Isometry3d>& goal)
      : centre_(centre), turn_(turn), goal_(goal) {}

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const std::optional<Eigen::Isometry3d>& goal() const { return goal_; }

  /// In steps that fingers follow without trouble; one pose where there is nothing to do.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start) const;
  /// In so many steps, or one pose.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start, int steps) const;

 private:
  Eigen::Vector3d centre_;
  Turn turn_;
  std::optional<Eigen::Isometry3d> goal_;
};

}  // namespace regrasp::gait
