#pragma once

#include <Eigen/Core>
#include <vector>

namespace regrasp::grasp {

/// A hard-finger contact with friction: a point and the unit normal that points into the object.
/// Planar contacts have z = 0 in both.
struct Contact {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  int face = -1;  ///< the object's face that p lies on, −1 where it is not known
};

/// The contacts of a hand at rest; the order carries no meaning.
using Grasp = std::vector<Contact>;

}  // namespace regrasp::grasp
