#pragma once

namespace regrasp::hand {

/// The hand that holds the object, as far as planners know it: fingers without joints.
struct Hand {
  /// Fingers, numbered from 0. 0: as many as the planner uses.
  int fingers = 0;
  /// Of the balls that the fingers end in, the object's unit of length (criteria/reach.h). 0: the
  /// fingers are points.
  double fingertip_radius = 0;
};

}  // namespace regrasp::hand
