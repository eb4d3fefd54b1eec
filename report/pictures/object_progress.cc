#include "report/pictures/object_progress.h"

#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "render/picture/caption.h"

namespace regrasp::report {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Smallest planned rotation (radians) and translation (metres) that are shown.
constexpr double kLeastAngle = Radians(0.5);
constexpr double kLeastDistance_m = 5e-4;
constexpr int kProgressDigits = 2;

Vector3d RotationVector(const Isometry3d& from, const Isometry3d& to) {
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  return turn.angle() * turn.axis();
}

}  // namespace

ObjectProgress::ObjectProgress(const std::vector<Isometry3d>& planned)
    : first_(planned.front()), last_(first_) {
  Vector3d path = Vector3d::Zero();  // sum of the small rotations
  for (std::size_t i = 1; i < planned.size(); ++i) {
    path += RotationVector(planned[i - 1], planned[i]);
  }
  const Isometry3d& goal = planned.back();
  goal_distance_m_ = (goal.translation() - first_.translation()).norm();
  if (!(path.norm() > kLeastAngle)) return;
  // After a whole turn the orientations do not determine the axis.
  const Vector3d net = RotationVector(first_, goal);
  axis_ = net.norm() > kLeastAngle ? net.normalized() : path.normalized();
  if (axis_.dot(path) < 0) axis_ = -axis_;
  goal_angle_ = AngleOf(goal, path.norm());
}

double ObjectProgress::AngleOf(const Isometry3d& X_WO, double near) const {
  const Eigen::Quaterniond turn(X_WO.linear() * first_.linear().transpose());
  const double angle = 2 * std::atan2(turn.vec().dot(axis_), turn.w());
  return angle + 2 * std::numbers::pi * std::round((near - angle) / (2 * std::numbers::pi));
}

void ObjectProgress::Follow(const Isometry3d& X_WO) {
  if (goal_angle_) angle_ = AngleOf(X_WO, angle_);
  last_ = X_WO;
}

std::string ObjectProgress::Text() const {
  if (goal_angle_) return render::AngleText(angle_) + " of " + render::AngleText(*goal_angle_);
  if (goal_distance_m_ < kLeastDistance_m) return "";
  const double distance_m = (last_.translation() - first_.translation()).norm();
  return FormatLength(distance_m, kProgressDigits) + " of " +
         FormatLength(goal_distance_m_, kProgressDigits);
}

}  // namespace regrasp::report
