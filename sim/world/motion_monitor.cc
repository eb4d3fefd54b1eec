#include "sim/world/motion_monitor.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "sim/world/cone_margin.h"

namespace regrasp::sim {
namespace {

double RotationAngle(const Eigen::Quaterniond& from, const Eigen::Isometry3d& to) {
  return from.angularDistance(Eigen::Quaterniond(to.linear()));
}

/// A force less steep than this part of the steepest one has the larger margin, whatever rounding
/// does to either.
constexpr double kSurelyLessSteep = 1 - 1e-12;

/// A turn may be a thousandth of a degree.
constexpr int kAngleDigits = 3;

std::string Name(FingerIndex finger) { return "finger " + std::to_string(finger); }

}  // namespace

double MeasureMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double radius) {
  return (to.translation() - from.translation()).norm() +
         radius * RotationAngle(Eigen::Quaterniond(from.linear()), to);
}

void MotionMonitor::Start(const Eigen::Isometry3d& X_SB) {
  const ReplaySettings settings = settings_;
  *this = MotionMonitor(settings);
  start_ = X_SB;
  start_turn_ = X_SB.linear();
}

void MotionMonitor::AddPose(const Eigen::Isometry3d& X_SB) {
  // As MeasureMotion; both parts are wanted after every step.
  const double displacement = (X_SB.translation() - start_.translation()).norm();
  const double rotation = RotationAngle(start_turn_, X_SB);
  const double moved = displacement + settings_.diameter_m / 2 * rotation;
  moved_now_ = moved;
  if (giving_) {
    give_ = std::max(give_, moved);
    return;
  }
  displacement_ = std::max(displacement_, displacement);
  rotation_ = std::max(rotation_, rotation);
  moved_ = std::max(moved_, moved);
  if (!object_moved_ && moved > settings_.tolerance * settings_.diameter_m) {
    object_moved_ = phase_;
  }
}

void MotionMonitor::AddUnrest() {
  if (object_moved_) return;
  object_moved_ = phase_;
  unrest_ = true;
}

bool MotionMonitor::lost() const {
  return moved_now_ > kLostMotion * settings_.tolerance * settings_.diameter_m;
}

void MotionMonitor::AddSlip(FingerIndex finger, double slip_m) {
  slip_ = std::max(slip_, slip_m);
  if (!slipped_ && slip_m > settings_.tolerance * settings_.diameter_m) {
    slipped_finger_ = finger;
    slipped_ = phase_;
  }
  if (finger == slipped_finger_) slip_now_ = slip_m;
}

void MotionMonitor::AddGap(FingerIndex finger, double gap_m) {
  if (!lost_ && gap_m > kLostGap * settings_.diameter_m) {
    lost_finger_ = finger;
    lost_ = phase_;
  }
  if (finger == lost_finger_) gap_now_ = gap_m;
}

void MotionMonitor::AddForce(FingerIndex finger, const Eigen::Vector3d& force,
                             const Eigen::Vector3d& normal, double twist) {
  const double pressing = force.dot(normal);
  if (pressing < kPressing * settings_.squeeze_N) return;
  // It is asked of every finger in every time step: the angle only where it may be the largest.
  const auto [steepest, is_first] = slopes_.try_emplace(finger, 0);
  const double tangential = TangentialForce(force, normal, twist);
  if (!is_first && tangential < kSurelyLessSteep * steepest->second * pressing) return;
  steepest->second = std::max(steepest->second, tangential / pressing);
  AddMargin(finger, ConeMargin(force, normal, std::atan(settings_.mu), twist), margins_);
}

void MotionMonitor::ForgetForces() {
  slopes_.clear();
  margins_.clear();
}

plan::Reason MotionMonitor::reason() const {
  if (lost_) return plan::Reason::kContactLost;
  if (slipped_) return plan::Reason::kSlipped;
  if (object_moved_) return plan::Reason::kObjectMoved;
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

std::string MotionMonitor::MotionText() const {
  return "moved by " + FormatLength(displacement_) + " and turned by " +
         FormatShort(Degrees(rotation_), kAngleDigits) + "°";
}

std::string MotionMonitor::detail() const {
  switch (reason()) {
    case plan::Reason::kContactLost:
      return Name(lost_finger_) + " came " + FormatLength(gap_now_) + " off the surface " + *lost_;
    case plan::Reason::kSlipped:
      return Name(slipped_finger_) + " slipped by " + FormatLength(slip_now_) + " " + *slipped_;
    case plan::Reason::kObjectMoved:
      return unrest_ ? "the object did not come to rest " + *object_moved_ + ": it " + MotionText()
                     : "the object " + MotionText() + " " + *object_moved_;
    default:
      return {};
  }
}

}  // namespace regrasp::sim
