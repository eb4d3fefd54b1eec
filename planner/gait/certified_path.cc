#include "planner/gait/certified_path.h"

#include <algorithm>

namespace regrasp::gait {
namespace {

/// Where shapes move by less than this between two samples and are still too near each other, they
/// are: metres.
constexpr double kFinest = 1e-4;

/// What moves by how much within an interval.
struct Bounds {
  std::vector<double> fingers;
  double object = 0;

  [[nodiscard]] double Largest() const {
    double largest = object;
    for (const double finger : fingers) largest = std::max(largest, finger);
    return largest;
  }
};

Bounds BoundsOf(const HandScene& scene, const Keyframe& from, const Keyframe& to) {
  Bounds bounds;
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    bounds.fingers.push_back(scene.MotionBound(finger, from.postures[finger], to.postures[finger]));
  }
  bounds.object = scene.MotionBound(from.pose, to.pose);
  return bounds;
}

/// Of the middle of an interval: everything in it is no farther from the middle than half of what
/// moves in all.
bool IsClearAround(const HandScene& scene, const Keyframe& middle, const Bounds& bounds,
                   const Touching& touching) {
  if (bounds.object > 0 && !scene.KeepsOffPalm(middle.pose, bounds.object / 2)) return false;
  std::vector<PlacedFinger> placed;
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    placed.push_back(scene.Place(finger, middle.postures[finger]));
    const double own = bounds.fingers[finger];
    const double both = own + bounds.object;
    // Two links of one finger may both move.
    if (own > 0 && !scene.KeepsOffHand(placed.back(), own)) return false;
    if (both > 0 && !scene.KeepsOffObject(placed.back(), middle.pose, touching[finger], both / 2)) {
      return false;
    }
    for (FingerIndex other{0}; other < finger; ++other) {
      const double pair = own + bounds.fingers[other];
      if (pair > 0 && !scene.KeepApart(placed[other], placed.back(), pair / 2)) return false;
    }
  }
  return true;
}

}  // namespace

bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
             const Touching& touching) {
  const Bounds bounds = BoundsOf(scene, from, to);
  const Keyframe middle = Between(from, to, 0.5);
  if (IsClearAround(scene, middle, bounds, touching)) return true;
  if (bounds.Largest() < kFinest) return false;
  return IsClear(scene, from, middle, touching) && IsClear(scene, middle, to, touching);
}

bool IsClear(const HandScene& scene, FingerIndex finger, const Posture& from, const Posture& to,
             const Eigen::Isometry3d& pose, TipContact tip,
             const std::vector<PlacedFinger>& others) {
  const double bound = scene.MotionBound(finger, from, to);
  const Posture middle = (from + to) / 2;
  const PlacedFinger placed = scene.Place(finger, middle);
  const auto clear_within = [&](double motion) {
    return scene.KeepsOffHand(placed, 2 * motion) &&
           scene.KeepsOffObject(placed, pose, tip, motion) &&
           std::ranges::all_of(others, [&](const PlacedFinger& other) {
             return scene.KeepApart(placed, other, motion);
           });
  };
  if (clear_within(bound / 2)) return true;
  if (bound < kFinest || !clear_within(0)) return false;
  return IsClear(scene, finger, from, middle, pose, tip, others) &&
         IsClear(scene, finger, middle, to, pose, tip, others);
}

}  // namespace regrasp::gait
