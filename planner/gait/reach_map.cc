#include "planner/gait/reach_map.h"

namespace regrasp::gait {
namespace {

/// Between two steps of a track no drive of a finger that keeps its contact turns by more, radians:
/// it would have gone over to another branch of postures.
constexpr double kJump = 0.35;

}  // namespace

kinematics::TipTarget TargetAt(const kinematics::Finger& finger, const SurfacePoint& contact,
                               const Eigen::Isometry3d& pose) {
  return {pose * (contact.p - finger.tip.radius * contact.n), pose.linear() * contact.n};
}

ReachMap::ReachMap(const HandScene& scene,
                   const std::vector<kinematics::InverseKinematics>& inverse,
                   const std::vector<SurfacePoint>& points, const PoseTrack& track)
    : scene_(scene), inverse_(inverse), points_(points), track_(track) {
  entries_.resize(inverse.size() * points.size() * static_cast<std::size_t>(track.steps() + 1));
}

std::size_t ReachMap::Key(FingerIndex finger, int point, int step) const {
  const std::size_t row = static_cast<std::size_t>(finger) * points_.size() + point;
  return row * static_cast<std::size_t>(track_.steps() + 1) + step;
}

void ReachMap::WorkOut(FingerIndex finger, int point, int step, Entry& entry) {
  entry.known = true;
  const Eigen::Isometry3d pose = track_.PoseAt(step);
  const kinematics::TipTarget target = TargetAt(scene_.finger(finger), points_[point], pose);
  if (!inverse_[finger].MayReach(target)) return;
  std::optional<Posture> posture = inverse_[finger].Solve(target);
  if (!posture) return;
  const PlacedFinger placed = scene_.Place(finger, *posture);
  if (!scene_.KeepsOffHand(placed)) return;
  if (!scene_.KeepsOffObject(placed, pose, TipContact::kTouching)) return;
  entry.posture = std::move(posture);
}

const Posture* ReachMap::Find(FingerIndex finger, int point, int step) {
  Entry& entry = entries_[Key(finger, point, step)];
  if (!entry.known) WorkOut(finger, point, step, entry);
  return entry.posture ? &*entry.posture : nullptr;
}

int ReachMap::RunEnd(FingerIndex finger, int point, int step, int direction) {
  const Posture* posture = Find(finger, point, step);
  for (int next = step + direction; next >= 0 && next <= track_.steps(); next += direction) {
    const Posture* other = Find(finger, point, next);
    if (other == nullptr || (*other - *posture).cwiseAbs().maxCoeff() > kJump) break;
    posture = other;
    step = next;
  }
  return step;
}

}  // namespace regrasp::gait
