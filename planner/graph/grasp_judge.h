#pragma once

#include <map>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp {

/// What a planner asks of grasps that a hand is to rest in.
class GraspJudge {
 public:
  /// @param object      must outlive this object.
  /// @param half_angle  friction, radians. @param min_quality  see QualityAtLeast.
  GraspJudge(const Object& object, double half_angle, double min_quality);

  /// Force closure, of the quality that is asked for, no two contacts at one point, and room for a
  /// fingertip at each (HasStandingRoom).
  [[nodiscard]] bool IsGood(const Grasp& grasp) const;

  /// Whether fingers can stand in it, good or not: at different points, and with room for
  /// fingertips.
  [[nodiscard]] bool CanStand(const Grasp& grasp) const;

  /// How good it is to rest in a grasp: its margin to the required half-angle, radians, where it is
  /// good; otherwise a negative number, the worse the lower its quality.
  /// Remembers what it was asked: searches come back to the same grasps. Not for several threads.
  [[nodiscard]] double Score(const Grasp& grasp) const;

  [[nodiscard]] double Quality(const Grasp& grasp) const;

  [[nodiscard]] const WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] double half_angle() const { return half_angle_; }
  [[nodiscard]] double min_quality() const { return min_quality_; }

 private:
  [[nodiscard]] double ComputeScore(const Grasp& grasp) const;

  const Object& object_;
  WrenchFrame frame_;
  double half_angle_;
  double min_quality_;
  double same_point_;
  mutable std::map<std::vector<double>, double> scores_;  ///< by the numbers of a grasp
};

}  // namespace regrasp
