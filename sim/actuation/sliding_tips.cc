#include "sim/actuation/sliding_tips.h"

#include <algorithm>

#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/hand_path.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;
using plan::HandState;

/// Of a tip, m/s.
constexpr double kSlideSpeed = 0.02;
/// Where it goes is seen over this share of its way.
constexpr double kLookAhead = 0.02;

}  // namespace

Vector3d PlannedTip(const kinematics::HandModel& hand, const HandState& state, FingerIndex finger) {
  const kinematics::Finger& chain = hand.fingers[finger];
  return state.pose.inverse() *
         kinematics::TipAt(chain, PostureOf(chain, state.joints[finger])).centre;
}

SlidingTips::SlidingTips(const HandWorld& world, const TimedPath& timed,
                         const plan::FingerGrasp& from, const plan::FingerGrasp& to)
    : hand_(world.hand()), timed_(timed) {
  const Eigen::Isometry3d to_object = world.object_pose().inverse();
  double way = 0;
  for (const plan::FingerContact& start : from) {
    const FingerIndex f = start.finger;
    const grasp::Contact& end = plan::FindFinger(to, f)->contact;
    if (end.p == start.contact.p && end.n == start.contact.n) continue;
    const Vector3d planned = PlannedTip(hand_, timed.At(0), f);
    tips_.push_back({f, to_object * world.tip(f) - planned});
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
