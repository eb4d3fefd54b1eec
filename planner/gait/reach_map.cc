#include "planner/gait/reach_map.h"

namespace regrasp::gait {
namespace {

/// Between two neighbours no drive of a finger that keeps its contact turns by more, radians: it
/// would have gone over to another branch of postures.
constexpr double kJump = 0.35;
/// How far ends of runs are looked for at once, steps; a power of two.
constexpr int kCellStride = 4;

bool IsNoJump(const Posture& from, const Posture& to, int steps) {
  return (to - from).cwiseAbs().maxCoeff() <= steps * kJump;
}

}  // namespace

kinematics::TipTarget TargetAt(const kinematics::Finger& finger, const SurfacePoint& contact,
                               const Eigen::Isometry3d& pose) {
  return {pose * (contact.p - finger.tip.radius * contact.n), pose.linear() * contact.n};
}

std::optional<Posture> ReachMap::WorkOut(FingerIndex finger, int point, int node) const {
  const Eigen::Isometry3d pose = grid_.PoseAt(node);
  const kinematics::TipTarget target = TargetAt(scene_.finger(finger), points_[point], pose);
  std::optional<Posture> posture = inverse_[finger].Solve(target);
  if (!posture) return std::nullopt;
  const PlacedFinger placed = scene_.Place(finger, *posture);
  if (!scene_.KeepsOffHand(placed)) return std::nullopt;
  if (!scene_.KeepsOffObject(placed, pose, TipContact::kTouching)) return std::nullopt;
  return posture;
}

ReachMap::Known& ReachMap::KnownAt(FingerIndex finger, int point, int node) {
  const std::size_t row = static_cast<std::size_t>(finger) * points_.size() + point;
  const auto [found, is_new] = known_.try_emplace(row * grid_.size() + node);
  if (is_new) found->second.posture = WorkOut(finger, point, node);
  return found->second;
}

const Posture* ReachMap::Find(FingerIndex finger, int point, int node) {
  const Known& known = KnownAt(finger, point, node);
  return known.posture ? &*known.posture : nullptr;
}

bool ReachMap::CanFollow(FingerIndex finger, int point, int node, int neighbour) {
  const Posture* from = Find(finger, point, node);
  const Posture* to = Find(finger, point, neighbour);
  return from != nullptr && to != nullptr && IsNoJump(*from, *to, 1);
}

int ReachMap::WorkOutRunEnd(FingerIndex finger, int point, int node) {
  const Posture* at = Find(finger, point, node);
  for (int stride = kCellStride; stride > 0; stride /= 2) {
    while (true) {
      const int next = grid_.Onward(node, stride);
      const Posture* then = next == PoseGrid::kNoNode ? nullptr : Find(finger, point, next);
      if (then == nullptr || !IsNoJump(*at, *then, stride)) break;
      node = next;
      at = then;
    }
  }
  return grid_.StepOf(node);
}

int ReachMap::RunEnd(FingerIndex finger, int point, int node) {
  Known& known = KnownAt(finger, point, node);
  if (known.run_end < 0) known.run_end = WorkOutRunEnd(finger, point, node);
  return known.run_end;
}

}  // namespace regrasp::gait
