#include "planner/gait/journey.h"

#include <algorithm>
#include <cmath>

namespace regrasp::gait {
namespace {

constexpr double kTurnStep = 0.06;    // radians
constexpr double kShiftStep = 0.004;  // metres

}  // namespace

PoseTrack Journey::From(const Eigen::Isometry3d& start, int steps) const {
  if (!goal_) return {start, centre_, turn_, Eigen::Vector3d::Zero(), turn_.angle == 0 ? 0 : steps};
  const Eigen::AngleAxisd turn(start.linear().transpose() * goal_->linear());
  const Eigen::Vector3d shift = *goal_ * centre_ - start * centre_;
  const bool stays = turn.angle() == 0 && shift.isZero(0);
  return {start, centre_, {turn.axis(), turn.angle()}, shift, stays ? 0 : steps};
}

PoseTrack Journey::From(const Eigen::Isometry3d& start) const {
  const PoseTrack way = From(start, 1);
  const double steps =
      std::max(std::abs(way.turn().angle) / kTurnStep, way.shift().norm() / kShiftStep);
  return From(start, std::max(1, static_cast<int>(std::ceil(steps))));
}

}  // namespace regrasp::gait
