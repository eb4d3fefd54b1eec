#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/gait/find_gait.h"

namespace regrasp::bench {

struct BestPose {
  Eigen::Isometry3d pose;
  std::vector<grasp::Contact> contacts;  ///< that a search of the request has
};

/// Where in the hand its reach is best for the object: the first pose that a search would begin
/// in.
/// @throws std::runtime_error  the object is nowhere within reach of the fingers.
[[nodiscard]] BestPose FindBestPose(const gait::GaitRequest& request);

}  // namespace regrasp::bench
