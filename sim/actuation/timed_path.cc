#include "sim/actuation/timed_path.h"

#include <algorithm>
#include <cmath>

#include "planner/plan/hand_path.h"

namespace regrasp::sim {
namespace {

using plan::HandState;

double TimeBetween(const HandState& a, const HandState& b, double joint_speed) {
  const Eigen::AngleAxisd turn(a.pose.linear().transpose() * b.pose.linear());
  double time = std::max((a.pose.translation() - b.pose.translation()).norm() / kObjectSpeed,
                         turn.angle() / kObjectTurn);
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

}  // namespace regrasp::sim
