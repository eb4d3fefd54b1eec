#pragma once

#include <Eigen/Geometry>
#include <string>
#include <variant>

#include "planner/base/number.h"

namespace regrasp::plan {

/// Tolerance of a goal pose, both ends included.
struct PoseTolerance {
  double length = 1e-3;       ///< distance of the reference point, metres
  double angle = Radians(1);  ///< angle of the rotation between the poses, radians
  bool operator==(const PoseTolerance&) const = default;
};

/// Goal: a pose of the object, with a tolerance.
struct PoseGoal {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< pose in the palm frame, metres
  PoseTolerance tolerance = {};
  /// Reference point of the distance, in the object's frame, metres.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// Goal: an axis of the object points in a direction. Rotation about it and position are free.
struct FacingGoal {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< unit vector in the object's frame
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector in the palm's frame
  double tolerance = Radians(1);                         ///< largest angle between both, radians
  /// 1 if the direction is up, -1 if it is down (GoalSet::WithUp), 0 if it is fixed in the palm.
  int along_up = 0;
};

/// Distance of a pose from a goal set: how far it exceeds each tolerance.
struct GoalDistance {
  double length = 0;  ///< metres
  double angle = 0;   ///< radians
  [[nodiscard]] bool IsZero() const { return length == 0 && angle == 0; }
};

/// Set of object poses that satisfy a goal.
/// Laws: Distance is zero if and only if the set contains the pose. A larger tolerance gives a
/// superset. Facing sets are invariant under rotation of the object about its axis, and under
/// translation.
class GoalSet {
 public:
  using Shape = std::variant<PoseGoal, FacingGoal>;

  /// A pose with the default tolerance. Conversion is implicit, because a pose is a goal.
  GoalSet(const Eigen::Isometry3d& pose)  // NOLINT(google-explicit-constructor)
      : shape_(PoseGoal{pose}) {}
  explicit GoalSet(const PoseGoal& goal) : shape_(goal) {}
  explicit GoalSet(const FacingGoal& goal) : shape_(goal) {}

  [[nodiscard]] const Shape& shape() const { return shape_; }
  /// Return the goal pose; null for a facing goal.
  [[nodiscard]] const PoseGoal* pose() const { return std::get_if<PoseGoal>(&shape_); }
  /// Return the facing goal; null for a goal pose.
  [[nodiscard]] const FacingGoal* facing() const { return std::get_if<FacingGoal>(&shape_); }
  /// Return whether this is a goal pose with the default tolerance.
  [[nodiscard]] bool HasDefaultTolerance() const {
    return pose() != nullptr && pose()->tolerance == PoseTolerance();
  }

  [[nodiscard]] GoalDistance Distance(const Eigen::Isometry3d& pose) const;
  [[nodiscard]] bool Contains(const Eigen::Isometry3d& pose) const {
    return Distance(pose).IsZero();
  }
  /// Return the pose of the set with the smallest rotation from `pose`, up to rounding.
  /// The reference point of a goal pose moves as little as possible; for a facing goal, `pivot`
  /// does not move.
  /// @param pivot  point in the object's frame, metres.
  [[nodiscard]] Eigen::Isometry3d Nearest(
      const Eigen::Isometry3d& pose, const Eigen::Vector3d& pivot = Eigen::Vector3d::Zero()) const;

  /// Return the set with smaller tolerances, at least zero.
  /// @param length, angle  reductions, metres and radians.
  [[nodiscard]] GoalSet Shrunk(double length, double angle) const;

  /// Return the set for another upward direction: a facing goal up or down follows it.
  /// @param up  unit vector in the palm's frame.
  [[nodiscard]] GoalSet WithUp(const Eigen::Vector3d& up) const;

 private:
  Shape shape_;
};

/// Goal of a list.
struct NamedGoal {
  std::string name;
  GoalSet set;
};

}  // namespace regrasp::plan
