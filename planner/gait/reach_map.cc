#include "planner/gait/reach_map.h"

namespace regrasp::gait {
namespace {

/// Between two neighbours no drive of a finger that keeps its contact turns by more, radians: it
/// would have gone over to another branch of postures.
constexpr double kJump = 0.35;

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

const Posture* ReachMap::Find(FingerIndex finger, int point, int node) {
  const std::size_t row = static_cast<std::size_t>(finger) * points_.size() + point;
  const auto [found, is_new] = known_.try_emplace(row * grid_.size() + node);
  if (is_new) found->second = WorkOut(finger, point, node);
  return found->second ? &*found->second : nullptr;
}

bool ReachMap::CanFollow(FingerIndex finger, int point, int node, int neighbour) {
  const Posture* from = Find(finger, point, node);
  const Posture* to = Find(finger, point, neighbour);
  return from != nullptr && to != nullptr && (*to - *from).cwiseAbs().maxCoeff() <= kJump;
}

int ReachMap::RunEnd(FingerIndex finger, int point, int node) {
  for (int next = grid_.Onward(node); next != PoseGrid::kNoNode; next = grid_.Onward(next)) {
    if (!CanFollow(finger, point, node, next)) break;
    node = next;
  }
  return grid_.StepOf(node);
}

}  // namespace regrasp::gait
