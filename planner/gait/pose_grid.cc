#include "planner/gait/pose_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <numeric>

#include "planner/object/rotation.h"

namespace regrasp::gait {

namespace {

constexpr double kTurnStep = 0.06;    // radians
constexpr double kShiftStep = 0.004;  // metres

/// Rotations about the direction of a facing goal, radians.
constexpr std::array kTwists = {Radians(45), -Radians(45), Radians(90), -Radians(90), Radians(180)};

/// Smallest rotation to a goal pose whose complement to a full rotation is also a track, radians.
constexpr double kFewestForLongWay = Radians(90);

constexpr double kShift = 0.008;  // metres
constexpr double kTilt = 0.15;    // radians
/// Maximum number of units of an offset.
constexpr int kMaxUnits = 3;

template <typename Offset>
int Units(const Offset& offset) {
  return std::transform_reduce(offset.begin(), offset.end(), 0, std::plus<>(),
                               [](int units) { return std::abs(units); });
}

PoseTrack InShortSteps(const PoseTrack& track) {
  if (track.steps() == 0) return track;
  const double steps =
      std::max(std::abs(track.turn().angle) / kTurnStep, track.shift().norm() / kShiftStep);
  return track.InSteps(std::max(1, static_cast<int>(std::ceil(steps))));
}

}  // namespace

std::optional<plan::GoalSet> ObjectTask::GoalFrom(const Eigen::Isometry3d& start) const {
  if (goal_ || !turn_tolerance_) return goal_;
  const PoseTrack whole(start, centre_, turn_, Eigen::Vector3d::Zero(), 1);
  return plan::GoalSet(plan::PoseGoal{whole.PoseAt(1), *turn_tolerance_, centre_});
}

PoseTrack ObjectTask::To(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end,
                         int steps) const {
  const Eigen::AngleAxisd turn = object::RotationInBody(start.linear(), end.linear());
  const Eigen::Vector3d shift = end * centre_ - start * centre_;
  const bool stays = turn.angle() == 0 && shift.isZero(0);
  return {start, centre_, {turn.axis(), turn.angle()}, shift, stays ? 0 : steps};
}

PoseTrack ObjectTask::From(const Eigen::Isometry3d& start, int steps) const {
  if (goal_) {
    const plan::GoalSet inner = goal_->Shrunk(kGoalDepth.length, kGoalDepth.angle);
    return To(start, inner.Nearest(start, centre_), steps);
  }
  Turn turn = turn_;
  if (turn_tolerance_) {
    const double shorter = std::max(0.0, turn_tolerance_->angle - kGoalDepth.angle);
    turn.angle = std::copysign(std::max(0.0, std::abs(turn.angle) - shorter), turn.angle);
  }
  const bool stays = turn.angle == 0 && shift_.isZero(0);
  return {start, centre_, turn, start.linear() * shift_, stays ? 0 : steps};
}

PoseTrack ObjectTask::From(const Eigen::Isometry3d& start) const {
  return InShortSteps(From(start, 1));
}

std::vector<PoseTrack> ObjectTask::Tracks(const Eigen::Isometry3d& start) const {
  std::vector<PoseTrack> tracks = {From(start)};
  const plan::FacingGoal* facing = goal_ ? goal_->facing() : nullptr;
  if (facing == nullptr) {
    const Turn turn = tracks.front().turn();
    if (goal_ && turn.angle > kFewestForLongWay) {
      const Turn opposite{turn.axis, turn.angle - 2 * std::numbers::pi};
      tracks.push_back(InShortSteps({start, centre_, opposite, tracks.front().shift(), 1}));
    }
    return tracks;
  }
  const Eigen::Isometry3d nearest = tracks.front().PoseAt(tracks.front().steps());
  for (const double twist : kTwists) {
    Eigen::Isometry3d end = nearest;
    end.linear() =
        Eigen::AngleAxisd(twist, facing->direction).toRotationMatrix() * nearest.linear();
    end.translation() = nearest * centre_ - end.linear() * centre_;
    tracks.push_back(InShortSteps(To(start, end, 1)));
  }
  return tracks;
}

PoseGrid::Offsets::Offsets(int dimensions) {
  std::map<Offset, int> numbers = {{{}, 0}};
  std::map<std::array<int, 3>, int> first_with;  // by tilt
  const auto one_off = [&](const Offset& offset, const auto& take) {
    for (int i = 0; i < dimensions; ++i) {
      for (const int unit : {-1, 1}) {
        Offset other = offset;
        other[i] += unit;
        take(other);
      }
    }
  };
  all.push_back({});
  for (std::size_t from = 0; from < all.size(); ++from) {
    if (Units(all[from]) == kMaxUnits) continue;
    // A copy, because `all` grows in the loop.
    one_off(Offset(all[from]), [&](const Offset& other) {
      if (numbers.try_emplace(other, all.size()).second) all.push_back(other);
    });
  }
  for (const Offset& offset : all) {
    const std::array tilt = {offset[3], offset[4], offset[5]};
    tilts.push_back(first_with.try_emplace(tilt, tilts.size()).first->second);
    beside.emplace_back();
    one_off(offset, [&](const Offset& other) {
      const auto found = numbers.find(other);
      if (found != numbers.end()) beside.back().push_back(found->second);
    });
    std::ranges::sort(beside.back());
  }
}

const PoseGrid::Offsets& PoseGrid::OffsetsBeside(const PoseTrack& track) {
  static const Offsets all_dimensions(6);
  // On a track the object rotates about the last axis anyway.
  static const Offsets without_last(5);
  return track.steps() == 0 ? all_dimensions : without_last;
}

PoseGrid::PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, End end)
    : track_(track), end_(end), offsets_(&OffsetsBeside(track)) {
  axes_ = object::AligningRotation(Eigen::Vector3d::UnitZ(), up).toRotationMatrix();
}

PoseGrid::PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, const plan::GoalSet& goal)
    : PoseGrid(track, up, End::kSet) {
  goal_ = goal.Shrunk(kGoalDepth.length, kGoalDepth.angle);
  first_goal_step_ = steps();
  while (first_goal_step_ > 0 && goal_->Contains(track.PoseAt(first_goal_step_ - 1))) {
    --first_goal_step_;
  }
}

PoseGrid PoseGrid::Reversed() const {
  PoseGrid reversed = *this;
  reversed.track_ = track_.Reversed();
  reversed.end_ = End::kPose;
  return reversed;
}

int PoseGrid::OffTrack(int node) const { return Units(OffsetOf(node)); }

bool PoseGrid::IsGoal(int node) const {
  if (node == goal()) return true;
  if (end_ == End::kSet) return IsInGoal(node);
  const Offset& offset = OffsetOf(node);
  return end_ == End::kOrientation && StepOf(node) == steps() && offset[3] == 0 && offset[4] == 0 &&
         offset[5] == 0;
}

bool PoseGrid::IsInGoal(int node) const {
  return StepOf(node) >= first_goal_step_ && goal_->Contains(PoseAt(node));
}

Eigen::Isometry3d PoseGrid::PoseAt(int node) const {
  const Offset& offset = OffsetOf(node);
  const Eigen::Isometry3d on_track = track_.PoseAt(StepOf(node));
  const Eigen::Vector3d centre = on_track * track_.centre();
  const Eigen::Vector3d shift = kShift * axes_ * Eigen::Vector3d(offset[0], offset[1], offset[2]);
  const Eigen::Vector3d tilt = kTilt * axes_ * Eigen::Vector3d(offset[3], offset[4], offset[5]);
  Eigen::Isometry3d pose = on_track;
  if (tilt.norm() > 0) {
    pose.linear() =
        Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix() * on_track.linear();
  }
  pose.translation() = centre + shift - pose.linear() * track_.centre();
  return pose;
}

std::vector<int> PoseGrid::Neighbours(int node) const {
  const int step = StepOf(node);
  std::vector<int> nodes;
  if (step > 0) nodes.push_back(node - offsets());
  for (const int k : offsets_->beside[node % offsets()]) nodes.push_back(step * offsets() + k);
  if (step < steps()) nodes.push_back(node + offsets());
  return nodes;
}

}  // namespace regrasp::gait
