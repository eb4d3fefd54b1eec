#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/gait/find_gait.h"

namespace regrasp::bench {

struct GoodPoses {
  std::vector<Eigen::Isometry3d> poses;  ///< the best first; one at least
  std::vector<grasp::Contact> contacts;  ///< that a search of the request has
};

/// Where in the hand its reach is good for the object: the poses that a search would begin in.
/// @throws std::runtime_error  the object is nowhere within reach of the fingers.
[[nodiscard]] GoodPoses FindGoodPoses(const gait::GaitRequest& request);

}  // namespace regrasp::bench
