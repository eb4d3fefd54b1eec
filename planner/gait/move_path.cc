#include "planner/gait/move_path.h"

#include "planner/gait/certified_path.h"

namespace regrasp::gait {
namespace {

/// Halvings of the way between two keyframes.
constexpr int kMostHalvings = 6;

/// One move.
class Mover {
 public:
  Mover(const HandSetup& setup, const Holding& holding) : setup_(setup), holding_(holding) {
    for (const int point : holding) {
      touching_.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
    }
  }

  /// Appends the keyframes of the way to one, without the first. @returns whether there is one.
  [[nodiscard]] bool Append(const Keyframe& from, const Keyframe& to, int halvings,
                            std::vector<Keyframe>& path) const {
    const Keyframe middle = Between(from, to, 0.5);
    if (TipsStay(middle)) {
      if (!IsClear(setup_.scene, from, to, touching_)) return false;
      path.push_back(to);
      return true;
    }
    if (halvings == 0) return false;
    const auto held = Held(middle);
    return held && Append(from, *held, halvings - 1, path) && Append(*held, to, halvings - 1, path);
  }

 private:
  [[nodiscard]] kinematics::TipTarget TargetOf(FingerIndex finger, const Keyframe& frame) const {
    return TargetAt(setup_.scene.finger(finger), setup_.points[holding_[finger]], frame.pose);
  }
  [[nodiscard]] bool TipsStay(const Keyframe& frame) const {
    for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
      if (holding_[finger] == kNone) continue;
      const Eigen::Vector3d centre =
          kinematics::TipAt(setup_.scene.finger(finger), frame.postures[finger]).centre;
      if ((centre - TargetOf(finger, frame).centre).norm() > kTipOff) return false;
    }
    return true;
  }
  /// The nearest postures in which tips are at their contacts.
  [[nodiscard]] std::optional<Keyframe> Held(Keyframe frame) const {
    for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
      if (holding_[finger] == kNone) continue;
      Posture& posture = frame.postures[finger];
      const auto held = setup_.inverse[finger].SolveNear(TargetOf(finger, frame), posture);
      if (!held) return std::nullopt;
      posture = *held;
    }
    return frame;
  }

  const HandSetup& setup_;
  const Holding& holding_;
  Touching touching_;
};

}  // namespace

std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup, const Holding& holding,
                                              const Keyframe& from, const Keyframe& to) {
  std::vector<Keyframe> path = {from};
  if (!Mover(setup, holding).Append(from, to, kMostHalvings, path)) return std::nullopt;
  return path;
}

}  // namespace regrasp::gait
