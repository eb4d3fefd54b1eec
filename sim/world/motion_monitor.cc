#include "sim/world/motion_monitor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/number.h"

namespace regrasp::sim {

double ConeMargin(const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                  double friction_angle, double twist) {
  return friction_angle -
         std::atan2(std::sqrt(TangentialSquare(force, normal, twist)), normal.dot(force));
}

void AddMargin(FingerIndex finger, double margin, FingerMargins& margins) {
  const auto [place, is_new] = margins.try_emplace(finger, margin);
  if (!is_new) place->second = std::min(place->second, margin);
}

std::optional<double> SmallestMargin(const FingerMargins& margins) {
  const FingerIndex finger = FingerOfSmallestMargin(margins);
  return finger.valid() ? std::optional(margins.at(finger)) : std::nullopt;
}

FingerIndex FingerOfSmallestMargin(const FingerMargins& margins) {
  const auto least =
      std::ranges::min_element(margins, {}, [](const auto& entry) { return entry.second; });
  return least == margins.end() ? FingerIndex() : least->first;
}

namespace {

/// Sine of half a rotation below which the series is exact to rounding: the first omitted term is
/// 15/336 of its sixth power.
constexpr double kSmallSine = 0.01;

double RotationAngle(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  // |R' − R| = 2 √2 sin(θ/2). Fast, because it is evaluated after every step, and the object rarely
  // rotates.
  const double sine = (to.linear() - from.linear()).norm() / (2 * std::numbers::sqrt2);
  if (sine < kSmallSine) {
    const double square = sine * sine;
    return 2 * sine * (1 + square * (1.0 / 6 + square * 3 / 40));
  }
  return Eigen::Quaterniond(from.linear()).angularDistance(Eigen::Quaterniond(to.linear()));
}

/// Placeholder for the slope of a finger without a contact force so far.
constexpr double kNoSlope = -1;

/// Number of digits of angles, because a rotation may be a thousandth of a degree.
constexpr int kAngleDigits = 3;

std::string Name(FingerIndex finger) { return "finger " + std::to_string(finger); }

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
  // As MeasureMotion, but both parts are required after every step.
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
  if (finger == slipped_finger_) slip_now_ = std::max(slip_now_, slip_m);
}

void MotionMonitor::AddGap(FingerIndex finger, double gap_m) {
  if (!lost_ && gap_m > kLostGap * settings_.diameter_m) {
    lost_finger_ = finger;
    lost_ = phase_;
  }
  if (finger == lost_finger_) gap_now_ = std::max(gap_now_, gap_m);
}

void MotionMonitor::AddForce(FingerIndex finger, const Eigen::Vector3d& force,
                             const Eigen::Vector3d& normal, double twist) {
  const double pressing = force.dot(normal);
  if (pressing < kPressing * settings_.grasp_force_N) return;
  // Evaluated for every finger in every time step, so the angle is computed only when it is read.
  if (finger >= std::ssize(slope_squares_)) slope_squares_.resize(finger + 1, kNoSlope);
  const double square = TangentialSquare(force, normal, twist);
  const double normal_square = pressing * pressing;
  double& steepest = slope_squares_[finger];
  if (square > steepest * normal_square) steepest = square / normal_square;
}

FingerMargins MotionMonitor::margins() const {
  FingerMargins margins;
  for (FingerIndex finger{0}; finger < std::ssize(slope_squares_); ++finger) {
    const double square = slope_squares_[finger];
    if (square == kNoSlope) continue;
    margins[finger] = std::atan(settings_.mu) - std::atan(std::sqrt(square));
  }
  return margins;
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
  const double limit = settings_.tolerance * settings_.diameter_m;
  return "moves " + FormatLengthWithLimit(displacement_, limit).value + " and rotates " +
         FormatPlain(Degrees(rotation_), kAngleDigits) + "°";
}

std::string MotionMonitor::detail() const {
  switch (reason()) {
    case plan::Reason::kContactLost:
      return Name(lost_finger_) + " is " +
             FormatLengthWithLimit(gap_now_, kLostGap * settings_.diameter_m).value +
             " off the surface " + *lost_;
    case plan::Reason::kSlipped:
      return Name(slipped_finger_) + " slips " +
             FormatLengthWithLimit(slip_now_, settings_.tolerance * settings_.diameter_m).value +
             " " + *slipped_;
    case plan::Reason::kObjectMoved:
      return unrest_ ? "the object does not settle " + *object_moved_ + ": it " + MotionText()
                     : "the object " + MotionText() + " " + *object_moved_;
    default:
      return {};
  }
}

}  // namespace regrasp::sim
