#include "planner/gait/move_path.h"

#include <cmath>

#include "planner/gait/certified_path.h"

namespace regrasp::gait {
namespace {

/// Of a track's steps.
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

}  // namespace

std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup, const PoseTrack& track,
                                              const Holding& holding, const Keyframe& from,
                                              double from_step, double to_step) {
  Touching touching;
  for (const int point : holding) {
    touching.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
  }
  std::vector<Keyframe> path = {from};
  const double direction = to_step < from_step ? -1 : 1;
  double at = from_step;
  double stride = 1;
  while (at != to_step) {
    const double next = std::abs(to_step - at) <= stride ? to_step : at + direction * stride;
    const auto frame = Follow(setup, holding, path.back(), track.PoseAt(next));
    if (!frame) return std::nullopt;
    if (!TipsStay(setup, holding, Between(path.back(), *frame, 0.5))) {
      stride /= 2;
      if (stride < kShortestStep) return std::nullopt;
      continue;
    }
    if (!IsClear(setup.scene, path.back(), *frame, touching)) return std::nullopt;
    path.push_back(*frame);
    at = next;
  }
  return path;
}

}  // namespace regrasp::gait
