#include "sim/world/motion_monitor.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "sim/world/cone_margin.h"

namespace regrasp::sim {
namespace {

double RotationAngle(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::Quaterniond a(from.linear()), b(to.linear());
  return a.angularDistance(b);
}

}  // namespace

double MeasureMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double radius) {
  return (to.translation() - from.translation()).norm() + radius * RotationAngle(from, to);
}

void MotionMonitor::Start(const Eigen::Isometry3d& X_SB) {
  const ReplaySettings settings = settings_;
  *this = MotionMonitor(settings);
  start_ = X_SB;
}

void MotionMonitor::AddPose(const Eigen::Isometry3d& X_SB) {
  // As MeasureMotion; both parts are wanted after every step.
  const double displacement = (X_SB.translation() - start_.translation()).norm();
  const double rotation = RotationAngle(start_, X_SB);
  const double moved = displacement + settings_.diameter_m / 2 * rotation;
  moved_now_ = moved;
  if (giving_) {
    give_ = std::max(give_, moved);
    return;
  }
  displacement_ = std::max(displacement_, displacement);
  rotation_ = std::max(rotation_, rotation);
  moved_ = std::max(moved_, moved);
  if (object_moved_.empty() && moved > settings_.tolerance * settings_.diameter_m) {
    object_moved_ = phase_ + ": the object moved";
  }
}

void MotionMonitor::AddUnrest() {
  if (object_moved_.empty()) object_moved_ = phase_ + ": the object did not come to rest";
}

bool MotionMonitor::lost() const {
  return moved_now_ > kLostMotion * settings_.tolerance * settings_.diameter_m;
}

void MotionMonitor::AddSlip(FingerIndex finger, double slip_m) {
  slip_ = std::max(slip_, slip_m);
  if (slipped_.empty() && slip_m > settings_.tolerance * settings_.diameter_m) {
    slipped_finger_ = finger;
    slipped_ = phase_ + ": finger " + std::to_string(finger) + " slipped";
  }
}

void MotionMonitor::AddGap(FingerIndex finger, double gap_m) {
  if (!lost_.empty() || gap_m <= kLostGap * settings_.diameter_m) return;
  lost_finger_ = finger;
  lost_ = phase_ + ": finger " + std::to_string(finger) + " is " + FormatShort(gap_m) +
          " m off the surface";
}

void MotionMonitor::AddForce(FingerIndex finger, const Eigen::Vector3d& force,
                             const Eigen::Vector3d& normal) {
  if (force.dot(normal) < kPressing * settings_.squeeze_N) return;
  AddMargin(finger, ConeMargin(force, normal, std::atan(settings_.mu)), margins_);
}

plan::Reason MotionMonitor::reason() const {
  if (!lost_.empty()) return plan::Reason::kContactLost;
  if (!slipped_.empty()) return plan::Reason::kSlipped;
  if (!object_moved_.empty()) return plan::Reason::kObjectMoved;
  return plan::Reason::kNone;
}

FingerIndex MotionMonitor::finger() const {
  switch (reason()) {
    case plan::Reason::kContactLost:
      return lost_finger_;
    case plan::Reason::kSlipped:
      return slipped_finger_;
    default:
      return {};
  }
}

std::string MotionMonitor::detail() const {
  switch (reason()) {
    case plan::Reason::kContactLost:
      return lost_;
    case plan::Reason::kSlipped:
      return slipped_ + ", " + FormatShort(slip_) + " m in the end";
    case plan::Reason::kObjectMoved:
      return object_moved_ + ", " + FormatShort(displacement_) + " m and " +
             FormatShort(Degrees(rotation_)) + " deg in the end";
    default:
      return {};
  }
}

}  // namespace regrasp::sim
