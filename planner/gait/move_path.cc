#include "planner/gait/move_path.h"

#include <algorithm>

#include "planner/gait/certified_path.h"

namespace regrasp::gait {
namespace {

/// Of the way from one pose to the next.
constexpr double kShortestStep = 1.0 / 64;

/// The keyframe at another pose: holding fingers follow from where they are.
std::optional<Keyframe> Follow(const HandSetup& setup, const Holding& holding,
                               const Keyframe& near_by, const Eigen::Isometry3d& pose) {
  Keyframe frame{pose, near_by.postures};
  for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
    if (holding[finger] == kNone) continue;
    const auto posture = setup.inverse[finger].SolveFrom(
        TargetAt(setup.scene.finger(finger), setup.points[holding[finger]], pose),
        near_by.postures[finger]);
    if (!posture) return std::nullopt;
    frame.postures[finger] = *posture;
  }
  return frame;
}

bool TipsStay(const HandSetup& setup, const Holding& holding, const Keyframe& middle) {
  for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
    if (holding[finger] == kNone) continue;
    const Eigen::Vector3d centre =
        kinematics::TipAt(setup.scene.finger(finger), middle.postures[finger]).centre;
    const auto target =
        TargetAt(setup.scene.finger(finger), setup.points[holding[finger]], middle.pose);
    if ((centre - target.centre).norm() > kTipOff) return false;
  }
  return true;
}

bool IsSameBranch(const Keyframe& a, const Keyframe& b) {
  for (std::size_t finger = 0; finger < a.postures.size(); ++finger) {
    if ((a.postures[finger] - b.postures[finger]).cwiseAbs().maxCoeff() > kSameBranch) return false;
  }
  return true;
}

/// Appends the keyframes of the way to the next pose. @returns whether there is one.
/// @param last  the keyframe there, where it is given.
bool AppendWay(const HandSetup& setup, const Holding& holding, const Touching& touching,
               const Eigen::Isometry3d& to, const Keyframe* last, std::vector<Keyframe>& path) {
  const Eigen::Isometry3d from = path.back().pose;
  double at = 0;
  double stride = 1;
  while (at < 1) {
    const double next = std::min(1.0, at + stride);
    auto frame = Follow(setup, holding, path.back(), next == 1 ? to : Between(from, to, next));
    if (!frame) return false;
    if (next == 1 && last != nullptr) {
      if (!IsSameBranch(*frame, *last)) return false;
      frame = *last;
    }
    if (!TipsStay(setup, holding, Between(path.back(), *frame, 0.5))) {
      stride /= 2;
      if (stride < kShortestStep) return false;
      continue;
    }
    if (!IsClear(setup.scene, path.back(), *frame, touching)) return false;
    path.push_back(*frame);
    at = next;
  }
  return true;
}

}  // namespace

std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup, const Holding& holding,
                                              const Keyframe& from,
                                              const std::vector<Eigen::Isometry3d>& poses,
                                              const Keyframe& to) {
  Touching touching;
  for (const int point : holding) {
    touching.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
  }
  std::vector<Keyframe> path = {from};
  for (const Eigen::Isometry3d& pose : poses) {
    if (!AppendWay(setup, holding, touching, pose, nullptr, path)) return std::nullopt;
  }
  if (!AppendWay(setup, holding, touching, to.pose, &to, path)) return std::nullopt;
  return path;
}

}  // namespace regrasp::gait
