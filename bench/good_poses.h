#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/gait/find_gait.h"

namespace regrasp::bench {

struct GoodPoses {
  std::vector<Eigen::Isometry3d> poses;  ///< poses, best first; at least one
  std::vector<grasp::Contact> contacts;  ///< contacts used by a search for the request
};

/// Find object poses in which the hand reaches the object well: the initial poses of a search.
/// @param turn, shift  motion throughout which it does (gait::ObjectTask).
/// @throws std::runtime_error  if no pose is within reach of the fingers.
[[nodiscard]] GoodPoses FindGoodPoses(const gait::GaitRequest& request,
                                      const planning::Turn& turn = {},
                                      const Eigen::Vector3d& shift = Eigen::Vector3d::Zero());

}  // namespace regrasp::bench
