#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::gait {

/// How object and hand stand at an instant. Between two that follow each other the drives go
/// straight, the object's origin goes straight and its orientation turns about one axis.
struct Keyframe {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the object in the palm's frame
  std::vector<kinematics::Posture> postures;               ///< of all fingers
};

[[nodiscard]] Eigen::Isometry3d Between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                        double share);
[[nodiscard]] Keyframe Between(const Keyframe& from, const Keyframe& to, double share);

}  // namespace regrasp::gait
