#pragma once

namespace regrasp::hand {

/// Default number of fingers in space.
/// Four contacts hold nearly every solid and three nearly every planar object, and one finger
/// switches. Grasps have at most this many contacts; a hand with more fingers leaves the others
/// free.
inline constexpr int kFingersInSpace = 5;
inline constexpr int kFingersInPlane = 4;

/// The hand that holds the object, for planners without hand models: fingers without joints.
struct Hand {
  /// Number of fingers, which are numbered from 0. 0: the default of the planner.
  int fingers = 0;
  /// Radius of the fingertip spheres, in the object's unit (criteria/reach.h). 0: points.
  double fingertip_radius = 0;
  /// Torsional friction length (grasp::Contact::torsion), in the object's unit. 0: hard points.
  double torsion = 0;

  /// Return the default number of fingers for objects of a dimension, 2 or 3.
  [[nodiscard]] constexpr int FingersIn(int dimension) const {
    if (fingers > 0) return fingers;
    return dimension == 3 ? kFingersInSpace : kFingersInPlane;
  }
};

}  // namespace regrasp::hand
