#pragma once

#include <Eigen/Geometry>

#include "planner/gait/find_gait.h"

namespace regrasp::bench {

/// Where in the hand its reach is best for the object: the first pose that a search would begin
/// in, of contacts drawn by the request's seed.
/// @throws std::runtime_error  the object is nowhere within reach of the fingers.
[[nodiscard]] Eigen::Isometry3d FindBestPose(const gait::GaitRequest& request);

}  // namespace regrasp::bench
