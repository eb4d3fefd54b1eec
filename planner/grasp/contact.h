#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::grasp {

/// A hard-finger contact with friction: a point and the unit normal that points into the object.
/// Planar contacts have z = 0 in both.
struct Contact {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  FaceIndex face = {};  ///< the object's face that p lies on, where it is known
};

/// The contacts of a hand at rest; the order carries no meaning.
using Grasp = std::vector<Contact>;

/// How many contacts a grasp has.
struct ContactLimits {
  int least = 0;
  int most = 0;
};

}  // namespace regrasp::grasp
