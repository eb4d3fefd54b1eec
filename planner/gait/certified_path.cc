#include "planner/gait/certified_path.h"

#include <algorithm>
#include <optional>

namespace regrasp::gait {
namespace {

/// Where shapes move by less than this between two samples and are still too near each other, they
/// are: metres.
constexpr double kFinest = 1e-4;

/// Two things that are to keep off each other.
struct Check {
  enum class Of { kPalmAndObject, kFingerAndHand, kLinksAndObject, kTipAndObject, kTwoFingers };
  Of of;
  FingerIndex finger = {};
  FingerIndex other = {};
};
using Checks = std::vector<Check>;

/// What stands still whatever happens, by finger; null: it moves.
using Standing = std::vector<const PlacedFinger*>;

/// How all stands in the middle of an interval, and how far it moves within.
class Middle {
 public:
  Middle(const HandScene& scene, const Standing& standing, const Touching& touching,
         const Keyframe& from, const Keyframe& to)
      : scene_(scene),
        standing_(standing),
        touching_(touching),
        frame_(Between(from, to, 0.5)),
        bounds_(standing.size(), 0),
        object_bound_(scene.MotionBound(from.pose, to.pose)),
        placed_(standing.size()) {
    for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
      if (standing[finger] != nullptr) continue;
      bounds_[finger] = scene.MotionBound(finger, from.postures[finger], to.postures[finger]);
    }
  }

  [[nodiscard]] const Keyframe& frame() const { return frame_; }
  [[nodiscard]] double LargestBound() const {
    return std::max(object_bound_, *std::ranges::max_element(bounds_));
  }

  /// Whether a check holds about the middle: everything in the interval is no farther from there
  /// than half of what moves in all. @param share  of the interval: 0 for the middle alone.
  [[nodiscard]] bool Passes(const Check& check, double share) {
    using enum Check::Of;
    const auto near = [&](double motion) { return share * motion / 2; };
    const auto keeps_off_object = [&](HandScene::Links links) {
      return scene_.KeepsOffObject(Placed(check.finger), frame_.pose, touching_[check.finger],
                                   near(bounds_[check.finger] + object_bound_), links);
    };
    switch (check.of) {
      case kPalmAndObject:
        return scene_.KeepsOffPalm(frame_.pose, near(object_bound_));
      case kFingerAndHand:
        // Two links of one finger may both move.
        return scene_.KeepsOffHand(Placed(check.finger), near(2 * bounds_[check.finger]));
      case kLinksAndObject:
        return keeps_off_object(HandScene::Links::kBehindTip);
      case kTipAndObject:
        return keeps_off_object(HandScene::Links::kTip);
      case kTwoFingers:
        return scene_.KeepApart(Placed(check.finger), Placed(check.other),
                                near(bounds_[check.finger] + bounds_[check.other]));
    }
    return false;
  }

 private:
  const PlacedFinger& Placed(FingerIndex finger) {
    if (standing_[finger] != nullptr) return *standing_[finger];
    if (!placed_[finger]) placed_[finger] = scene_.Place(finger, frame_.postures[finger]);
    return *placed_[finger];
  }

  const HandScene& scene_;
  const Standing& standing_;
  const Touching& touching_;
  Keyframe frame_;
  std::vector<double> bounds_;  ///< by finger
  double object_bound_;
  std::vector<std::optional<PlacedFinger>> placed_;
};

/// Whether all checks hold between two keyframes: an interval is halved for those that do not hold
/// about its middle. Most hold in the large; a fingertip that touches is looked at closely.
bool CertifyOpen(const HandScene& scene, const Standing& standing, const Touching& touching,
                 const Keyframe& from, const Keyframe& to, const Checks& checks) {
  Middle middle(scene, standing, touching, from, to);
  const bool is_finest = middle.LargestBound() < kFinest;
  Checks open;
  for (const Check& check : checks) {
    if (middle.Passes(check, 1)) continue;
    if (is_finest || !middle.Passes(check, 0)) return false;
    open.push_back(check);
  }
  return open.empty() || (CertifyOpen(scene, standing, touching, from, middle.frame(), open) &&
                          CertifyOpen(scene, standing, touching, middle.frame(), to, open));
}

/// What can change where these things move.
Checks ChecksOf(const std::vector<bool>& moves, bool object_moves) {
  using enum Check::Of;
  Checks checks;
  if (object_moves) checks.push_back({kPalmAndObject});
  for (FingerIndex finger{0}; finger < std::ssize(moves); ++finger) {
    if (moves[finger]) checks.push_back({kFingerAndHand, finger});
    if (moves[finger] || object_moves) {
      checks.push_back({kLinksAndObject, finger});
      checks.push_back({kTipAndObject, finger});
    }
    for (FingerIndex other{0}; other < finger; ++other) {
      if (moves[finger] || moves[other]) checks.push_back({kTwoFingers, finger, other});
    }
  }
  return checks;
}

}  // namespace

bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
             const Touching& touching) {
  std::vector<bool> moves;
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    moves.push_back(scene.MotionBound(finger, from.postures[finger], to.postures[finger]) > 0);
  }
  const bool object_moves = from.pose.matrix() != to.pose.matrix();
  return CertifyOpen(scene, Standing(moves.size(), nullptr), touching, from, to,
                     ChecksOf(moves, object_moves));
}

bool IsClear(const HandScene& scene, FingerIndex finger, const Posture& from, const Posture& to,
             const Eigen::Isometry3d& pose, TipContact tip,
             const std::vector<PlacedFinger>& others) {
  const int count = scene.finger_count();
  std::vector<bool> moves(count, false);
  moves[finger] = true;
  Standing standing(count, nullptr);
  for (const PlacedFinger& other : others) standing[other.finger] = &other;
  Keyframe begin{pose, std::vector<Posture>(count)};
  Keyframe end = begin;
  begin.postures[finger] = from;
  end.postures[finger] = to;
  Touching touching(count, TipContact::kFree);
  touching[finger] = tip;
  return CertifyOpen(scene, standing, touching, begin, end, ChecksOf(moves, false));
}

}  // namespace regrasp::gait
