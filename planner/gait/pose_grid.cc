#include "planner/gait/pose_grid.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace regrasp::gait {
namespace {

constexpr double kShift = 0.008;  // metres
constexpr double kTilt = 0.15;    // radians
/// Units that an offset has in all.
constexpr int kMostUnits = 3;

template <typename Offset>
int Units(const Offset& offset) {
  return std::transform_reduce(offset.begin(), offset.end(), 0, std::plus<>(),
                               [](int units) { return std::abs(units); });
}

}  // namespace

PoseGrid::PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, End end)
    : track_(track), up_(up), end_(end) {
  axes_ = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up).toRotationMatrix();
  // Along a track objects turn about the last one anyway.
  const std::size_t dimensions = track.steps() == 0 ? 6 : 5;
  offsets_.push_back({});
  for (std::size_t from = 0; from < offsets_.size(); ++from) {
    if (Units(offsets_[from]) == kMostUnits) continue;
    for (std::size_t i = 0; i < dimensions; ++i) {
      for (const int unit : {-1, 1}) {
        Offset offset = offsets_[from];
        offset[i] += unit;
        if (std::ranges::find(offsets_, offset) == offsets_.end()) offsets_.push_back(offset);
      }
    }
  }
  for (const Offset& offset : offsets_) {
    const auto first = std::ranges::find_if(offsets_, [&](const Offset& other) {
      return std::equal(other.begin() + 3, other.end(), offset.begin() + 3);
    });
    tilts_.push_back(static_cast<int>(first - offsets_.begin()));
    beside_.emplace_back();
    for (int k = 0; k < offsets(); ++k) {
      Offset difference = offsets_[k];
      for (std::size_t i = 0; i < offset.size(); ++i) difference[i] -= offset[i];
      if (Units(difference) == 1) beside_.back().push_back(k);
    }
  }
}

PoseGrid PoseGrid::Reversed() const { return {track_.Reversed(), up_, End::kPose}; }

int PoseGrid::OffTrack(int node) const { return Units(offsets_[node % offsets()]); }

bool PoseGrid::IsGoal(int node) const {
  if (node == goal()) return true;
  const Offset& offset = offsets_[node % offsets()];
  return end_ == End::kOrientation && StepOf(node) == steps() && offset[3] == 0 && offset[4] == 0 &&
         offset[5] == 0;
}

Eigen::Isometry3d PoseGrid::PoseAt(int node) const {
  const Offset& offset = offsets_[node % offsets()];
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
  for (const int k : beside_[node % offsets()]) nodes.push_back(step * offsets() + k);
  if (step < steps()) nodes.push_back(node + offsets());
  return nodes;
}

}  // namespace regrasp::gait
