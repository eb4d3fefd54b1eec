#pragma once

namespace regrasp {

/// What is asked of a grasp that a hand is to rest in.
struct GraspCriteria {
  double half_angle = 0;  ///< of the friction cones, radians in (0, π/2)
  /// Quality (grasp/quality.h) that random grasps have at least. A sequence keeps to such grasps
  /// where it can.
  double min_quality = 0.01;
};

}  // namespace regrasp
