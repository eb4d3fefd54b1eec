#include "planner/plan/goal_set.h"

#include <algorithm>
#include <cmath>

#include "planner/object/rotation.h"

namespace regrasp::plan {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

GoalDistance DistanceFrom(const PoseGoal& goal, const Isometry3d& pose) {
  const double length = (pose * goal.point - goal.pose * goal.point).norm();
  const double angle = object::RotationInWorld(goal.pose.linear(), pose.linear()).angle();
  return {std::max(0.0, length - goal.tolerance.length),
          std::max(0.0, angle - goal.tolerance.angle)};
}

GoalDistance DistanceFrom(const FacingGoal& goal, const Isometry3d& pose) {
  return {0,
          std::max(0.0, AngleBetween(pose.linear() * goal.axis, goal.direction) - goal.tolerance)};
}

Isometry3d NearestTo(const PoseGoal& goal, const Isometry3d& pose, const Vector3d& /*pivot*/) {
  const GoalDistance off = DistanceFrom(goal, pose);
  Isometry3d nearest = pose;
  if (goal.tolerance.angle == 0) {
    nearest.linear() = goal.pose.linear();
  } else if (off.angle > 0) {
    const Vector3d axis = object::RotationInWorld(pose.linear(), goal.pose.linear()).axis();
    nearest.linear() = Eigen::AngleAxisd(off.angle, axis).toRotationMatrix() * pose.linear();
  }
  const Vector3d wanted = goal.pose * goal.point;
  Vector3d point = pose * goal.point;
  if (off.length > 0) point = wanted + goal.tolerance.length * (point - wanted).normalized();
  if (goal.tolerance.length == 0 && goal.tolerance.angle == 0) {
    nearest.translation() = goal.pose.translation();
  } else {
    nearest.translation() = point - nearest.linear() * goal.point;
  }
  return nearest;
}

Isometry3d NearestTo(const FacingGoal& goal, const Isometry3d& pose, const Vector3d& pivot) {
  const double angle = DistanceFrom(goal, pose).angle;
  if (angle == 0) return pose;
  const Vector3d axis = pose.linear() * goal.axis;
  Vector3d about = axis.cross(goal.direction);
  // Opposite directions: any perpendicular axis.
  constexpr double kParallel = 1e-9;
  if (about.norm() < kParallel) about = axis.unitOrthogonal();
  Isometry3d nearest = pose;
  nearest.linear() =
      Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix() * pose.linear();
  nearest.translation() = pose * pivot - nearest.linear() * pivot;
  return nearest;
}

}  // namespace

GoalDistance GoalSet::Distance(const Isometry3d& pose) const {
  return std::visit([&](const auto& goal) { return DistanceFrom(goal, pose); }, shape_);
}

Isometry3d GoalSet::Nearest(const Isometry3d& pose, const Vector3d& pivot) const {
  return std::visit([&](const auto& goal) { return NearestTo(goal, pose, pivot); }, shape_);
}

GoalSet GoalSet::Shrunk(double length, double angle) const {
  if (const FacingGoal* goal = facing()) {
    FacingGoal smaller = *goal;
    smaller.tolerance = std::max(0.0, smaller.tolerance - angle);
    return GoalSet(smaller);
  }
  PoseGoal smaller = *pose();
  smaller.tolerance.length = std::max(0.0, smaller.tolerance.length - length);
  smaller.tolerance.angle = std::max(0.0, smaller.tolerance.angle - angle);
  return GoalSet(smaller);
}

GoalSet GoalSet::WithUp(const Vector3d& up) const {
  if (facing() == nullptr || facing()->along_up == 0) return *this;
  FacingGoal turned = *facing();
  turned.direction = turned.along_up * up;
  return GoalSet(turned);
}

}  // namespace regrasp::plan
