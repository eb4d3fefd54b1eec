#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::grasp {

/// Contact with friction: a point and the unit normal that points into the object.
/// Planar contacts have z = 0 in both.
///
/// With friction coefficient μ it can apply a force f and a torque τ about the normal with
///
///     f·n > 0,   |f_t|² + (τ / torsion)² ≤ (μ f·n)²,   f_t = f − (f·n) n.
///
/// This is the ellipsoid of Howe and Cutkosky 1996 for a soft finger. With a torsion of 0 there is
/// no torque: a hard-finger contact, which has the friction cone only.
struct Contact {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  FaceIndex face = {};  ///< face of the object that p is on, if known
  /// Torsional friction length in the unit of p: largest torque about the normal divided by the
  /// largest tangential force. 0 for a hard-finger contact, and in the plane.
  double torsion = 0;
};

/// Contacts of a static grasp; their order has no meaning.
using Grasp = std::vector<Contact>;

/// Limits on the number of contacts of a grasp.
struct ContactLimits {
  int least = 0;
  int most = 0;
};

}  // namespace regrasp::grasp
