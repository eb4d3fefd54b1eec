#include "sim/actuation/sliding_tips.h"

#include <algorithm>
#include <cmath>

#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/rotation.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

namespace {

using plan::HandState;

double TimeBetween(const HandState& a, const HandState& b, double joint_speed) {
  double time =
      std::max((a.pose.translation() - b.pose.translation()).norm() / kObjectSpeed,
               object::RotationInBody(a.pose.linear(), b.pose.linear()).angle() / kObjectTurn);
  for (std::size_t f = 0; f < a.joints.size(); ++f) {
    for (std::size_t k = 0; k < a.joints[f].size(); ++k) {
      time = std::max(time, std::abs(a.joints[f][k] - b.joints[f][k]) / joint_speed);
    }
  }
  return time;
}

}  // namespace

TimedPath::TimedPath(const plan::HandPath& path, double joint_speed) : path_(path), times_{0} {
  for (std::size_t i = 1; i < path.size(); ++i) {
    times_.push_back(times_.back() + TimeBetween(path[i - 1], path[i], joint_speed));
  }
}

double TimedPath::duration() const { return times_.back() + std::min(kPathRamp, times_.back()); }

HandState TimedPath::At(double time) const {
  const double length = times_.back();
  const double ramp = std::min(kPathRamp, length);
  const double left = duration() - time;
  if (left <= 0) return path_.back();
  double at = time - ramp / 2;
  if (time < ramp) at = time * time / (2 * ramp);
  if (left < ramp) at = length - left * left / (2 * ramp);
  const auto next = std::ranges::upper_bound(times_, std::max(0.0, at));
  if (next == times_.end()) return path_.back();
  const auto i = next - times_.begin();
  return plan::StateBetween(path_[i - 1], path_[i],
                            (at - times_[i - 1]) / (times_[i] - times_[i - 1]));
}

namespace {

using Eigen::Vector3d;

/// Speed of a sliding fingertip, m/s.
constexpr double kSlideSpeed = 0.02;
/// Share of the path over which the direction of motion is computed.
constexpr double kLookAhead = 0.02;

}  // namespace

Vector3d PlannedTip(const kinematics::HandModel& hand, const HandState& state, FingerIndex finger) {
  const kinematics::Finger& chain = hand.fingers[finger];
  return state.pose.inverse() *
         kinematics::TipAt(chain, ConfigurationOf(chain, state.joints[finger])).centre;
}

SlidingTips::SlidingTips(const HandControl& control, const kinematics::HandModel& hand,
                         const TimedPath& timed, const plan::FingerGrasp& from,
                         const plan::FingerGrasp& to)
    : hand_(hand), timed_(timed) {
  double way = 0;
  for (const plan::FingerContact& start : from) {
    const FingerIndex f = start.finger;
    const grasp::Contact& end = plan::FindFinger(to, f)->contact;
    if (end.p == start.contact.p && end.n == start.contact.n) continue;
    const Vector3d planned = PlannedTip(hand_, timed.At(0), f);
    tips_.push_back({f, control.TipInObject(f) - planned});
    way = std::max(way, (PlannedTip(hand_, StateAt(1), f) - planned).norm());
  }
  duration_ = std::max(timed.duration(), way / kSlideSpeed);
}

HandState SlidingTips::StateAt(double share) const { return timed_.At(share * timed_.duration()); }

Vector3d SlidingTips::CentreAt(FingerIndex finger, double share) const {
  const auto tip = std::ranges::find(tips_, finger, &Tip::finger);
  return PlannedTip(hand_, StateAt(share), finger) + (1 - share) * tip->off_O;
}

std::vector<SlidingFinger> SlidingTips::At(double share) const {
  const double from = std::min(share, 1 - kLookAhead);
  std::vector<SlidingFinger> sliding;
  for (const Tip& tip : tips_) {
    sliding.push_back(
        {tip.finger, CentreAt(tip.finger, from + kLookAhead) - CentreAt(tip.finger, from)});
  }
  return sliding;
}

}  // namespace regrasp::sim
