#pragma once

namespace regrasp::hand {

/// Fingers of the hand that plans are made for where nothing else is said: four contacts hold
/// nearly every solid and three nearly every planar object, and one finger switches. Sets of held
/// contacts hold no more; a hand with more fingers leaves the others free.
inline constexpr int kFingersInSpace = 5;
inline constexpr int kFingersInPlane = 4;

/// The hand that holds the object, as far as planners know it: fingers without joints.
struct Hand {
  /// Fingers, numbered from 0. 0: as many as the planner uses.
  int fingers = 0;
  /// Of the balls that the fingers end in, the object's unit of length (criteria/reach.h). 0: the
  /// fingers are points.
  double fingertip_radius = 0;
  /// Of its contacts (grasp::Contact::torsion), the object's unit of length. 0: hard points.
  double torsion = 0;

  /// Fingers for objects of a dimension, 2 or 3: the default where the number is 0.
  [[nodiscard]] constexpr int FingersIn(int dimension) const {
    if (fingers > 0) return fingers;
    return dimension == 3 ? kFingersInSpace : kFingersInPlane;
  }
};

}  // namespace regrasp::hand
