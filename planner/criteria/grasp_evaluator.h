#pragma once

#include <map>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp {

/// Contacts this close, relative to the diameter, are at the same point: twice the tolerance for
/// reading, so that no checker takes them for coincident after rounding.
inline constexpr double kSamePoint = 2 * kPointTolerance;

/// What a planner asks of grasps that a hand is to rest in.
class GraspEvaluator {
 public:
  /// @param object      must outlive this object.
  /// @param half_angle  friction, radians. @param min_quality  see QualityAtLeast.
  /// @param finger_radius  of fingers that are not points (reach.h), the object's unit of length.
  GraspEvaluator(const Object& object, double half_angle, double min_quality,
                 double finger_radius = 0);

  /// Force closure, of the quality that is asked for, and fingers can stand in it.
  [[nodiscard]] bool IsGood(const Grasp& grasp) const;

  /// Whether fingers can stand in it, good or not: at different points, with room for a fingertip
  /// at each (HasClearance), and with the radius that they have (CanHold).
  [[nodiscard]] bool CanStand(const Grasp& grasp) const;

  /// How good it is to rest in a grasp: its margin to the required half-angle, radians, where it is
  /// good; otherwise a negative number, the worse the lower its quality.
  /// Remembers what it was asked: searches come back to the same grasps. Not for several threads.
  [[nodiscard]] double Score(const Grasp& grasp) const;

  [[nodiscard]] double Quality(const Grasp& grasp) const;

  [[nodiscard]] const WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] double half_angle() const { return half_angle_; }
  [[nodiscard]] double min_quality() const { return min_quality_; }
  [[nodiscard]] double finger_radius() const { return finger_radius_; }
  [[nodiscard]] const Object& object() const { return object_; }

 private:
  [[nodiscard]] double ComputeScore(const Grasp& grasp) const;

  const Object& object_;
  WrenchFrame frame_;
  double half_angle_;
  double min_quality_;
  double same_point_;
  double finger_radius_;
  mutable std::map<std::vector<double>, double> scores_;  ///< by the numbers of a grasp
};

}  // namespace regrasp
