#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::grasp {

/// A contact with friction: a point and the unit normal that points into the object. Planar
/// contacts have z = 0 in both.
///
/// What it can apply is a force f and a torque τ about the normal with, at friction μ,
///
///     f·n > 0,   |f_t|² + (τ / torsion)² ≤ (μ f·n)²,   f_t = f − (f·n) n,
///
/// the ellipsoid of Howe and Cutkosky 1996 for a soft finger; with a torsion of 0 there is no
/// torque, and the contact is a hard point with the friction cone alone.
struct Contact {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  FaceIndex face = {};  ///< the object's face that p lies on, where it is known
  /// The largest torque about the normal over the largest tangential force, a length in the unit of
  /// p; 0 of a hard point, and in the plane.
  double torsion = 0;
};

/// The contacts of a hand at rest; the order carries no meaning.
using Grasp = std::vector<Contact>;

/// How many contacts a grasp has.
struct ContactLimits {
  int least = 0;
  int most = 0;
};

}  // namespace regrasp::grasp
