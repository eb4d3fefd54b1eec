#include "planner/gait/finger_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace regrasp::gait {

namespace {

/// Finest certified interval: if shapes move less than this between two samples and are still too
/// close, the path is rejected. Metres.
constexpr double kFinestInterval = 1e-4;

/// A pair of bodies that must be clear of each other.
struct Check {
  enum class Of { kPalmAndObject, kFingerAndHand, kLinksAndObject, kTipAndObject, kTwoFingers };
  Of of;
  FingerIndex finger = {};
  FingerIndex other = {};
};
using Checks = std::vector<Check>;

/// Stationary fingers [finger]; null for moving fingers.
using Stationary = std::vector<const PlacedFinger*>;

/// Midpoint of a path interval, with bounds on the motion within the interval.
class Midpoint {
 public:
  Midpoint(const HandScene& scene, const Stationary& stationary, const Touching& touching,
           const Keyframe& from, const Keyframe& to)
      : scene_(scene),
        stationary_(stationary),
        touching_(touching),
        frame_(Between(from, to, 0.5)),
        bounds_(stationary.size(), 0),
        object_bound_(scene.MotionBound(from.pose, to.pose)),
        placed_(stationary.size()) {
    for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
      if (stationary[finger] != nullptr) continue;
      bounds_[finger] =
          scene.MotionBound(finger, from.configurations[finger], to.configurations[finger]);
    }
  }

  [[nodiscard]] const Keyframe& frame() const { return frame_; }
  [[nodiscard]] double LargestBound() const {
    return std::max(object_bound_, *std::ranges::max_element(bounds_));
  }

  /// Return whether a check passes at the midpoint with clearance for the motion.
  /// No point of the interval is farther from the midpoint than half of the total motion.
  /// @param fraction  fraction of the interval; 0 for the midpoint alone.
  [[nodiscard]] bool Passes(const Check& check, double fraction) {
    using enum Check::Of;
    const auto near = [&](double motion) { return fraction * motion / 2; };
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
    if (stationary_[finger] != nullptr) return *stationary_[finger];
    if (!placed_[finger]) placed_[finger] = scene_.Place(finger, frame_.configurations[finger]);
    return *placed_[finger];
  }

  const HandScene& scene_;
  const Stationary& stationary_;
  const Touching& touching_;
  Keyframe frame_;
  std::vector<double> bounds_;  ///< [finger]
  double object_bound_;
  std::vector<std::optional<PlacedFinger>> placed_;
};

/// Certify all checks between two keyframes.
/// An interval is halved for the checks that fail at its midpoint. Most checks pass on long
/// intervals; touching fingertips need short ones.
bool CertifyOpen(const HandScene& scene, const Stationary& stationary, const Touching& touching,
                 const Keyframe& from, const Keyframe& to, const Checks& checks) {
  Midpoint middle(scene, stationary, touching, from, to);
  const bool is_finest = middle.LargestBound() < kFinestInterval;
  Checks open;
  for (const Check& check : checks) {
    if (middle.Passes(check, 1)) continue;
    if (is_finest || !middle.Passes(check, 0)) return false;
    open.push_back(check);
  }
  return open.empty() || (CertifyOpen(scene, stationary, touching, from, middle.frame(), open) &&
                          CertifyOpen(scene, stationary, touching, middle.frame(), to, open));
}

/// Return the checks whose result can change when these bodies move.
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

constexpr double kStride = 0.35;  // radians, norm over all joints
constexpr int kShortcuts = 30;
/// Number of extensions after which the search stops if one tree has not grown.
constexpr int kMaxTrapped = 30;

/// Height of a lift path above the contact, metres: minimum and maximum.
constexpr double kMinLift = 0.003;
constexpr double kMaxLift = 0.020;
constexpr double kLiftStep = 0.002;  // between configurations of the lift path
/// Distance from the contact within which a fingertip may be as close to the object as a touching
/// one, metres. The checker (sim/hand/check_hand.cc) allows 2 mm more.
constexpr double kTouchingLift = 0.010;
/// Tilted lift directions, if the normal is blocked: angle from the normal, radians, and number of
/// directions.
constexpr double kTiltedLift = 0.8;
constexpr int kTiltedDirections = 6;

/// Return whether a finger may move linearly between two joint configurations.
bool IsClear(const HandScene& scene, FingerIndex finger, const JointConfiguration& from,
             const JointConfiguration& to, TipContact tip, const Surroundings& around) {
  return IsClear(scene, finger, from, to, around.pose, tip, around.others) &&
         (around.rolled.empty() ||
          IsClear(scene, finger, from, to, around.pose, tip, around.rolled));
}

struct Tree {
  std::vector<JointConfiguration> nodes;
  std::vector<int> parents;

  [[nodiscard]] bool IsRoot() const { return nodes.size() == 1; }

  int Nearest(const JointConfiguration& configuration) const {
    int best = 0;
    for (int i = 1; i < static_cast<int>(nodes.size()); ++i) {
      if ((nodes[i] - configuration).squaredNorm() < (nodes[best] - configuration).squaredNorm())
        best = i;
    }
    return best;
  }
  [[nodiscard]] FingerPath PathTo(int node) const {
    FingerPath path;
    for (; node >= 0; node = parents[node]) path.push_back(nodes[node]);
    std::ranges::reverse(path);
    return path;
  }
};

/// RRT-Connect for one finger.
class Connector {
 public:
  Connector(const HandScene& scene, FingerIndex finger, const Surroundings& around,
            RandomStream& random)
      : scene_(scene), finger_(finger), around_(around), random_(random) {}

  std::optional<FingerPath> Find(const JointConfiguration& from, const JointConfiguration& to,
                                 int most_extensions) {
    if (IsFree(from, to)) return FingerPath{from, to};
    std::array<Tree, 2> trees = {Tree{{from}, {-1}}, Tree{{to}, {-1}}};
    for (int i = 0; i < most_extensions; ++i) {
      if (i == kMaxTrapped && std::ranges::any_of(trees, &Tree::IsRoot)) break;
      Tree& growing = trees[i % 2];
      Tree& other = trees[1 - i % 2];
      if (!Extend(growing, scene_.DrawConfiguration(finger_, random_))) continue;
      const JointConfiguration reached = growing.nodes.back();
      // Extend until blocked or connected.
      while (Extend(other, reached)) {
        if ((other.nodes.back() - reached).norm() > 0) continue;
        FingerPath path = trees[0].PathTo(static_cast<int>(trees[0].nodes.size()) - 1);
        FingerPath back = trees[1].PathTo(static_cast<int>(trees[1].nodes.size()) - 1);
        path.insert(path.end(), back.rbegin() + 1, back.rend());
        return Shortened(std::move(path));
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool IsFree(const JointConfiguration& from, const JointConfiguration& to) const {
    return IsClear(scene_, finger_, from, to, TipContact::kFree, around_);
  }
  [[nodiscard]] bool IsFreeAt(const JointConfiguration& configuration) const {
    const PlacedFinger placed = scene_.Place(finger_, configuration);
    const auto keeps_apart = [&](const PlacedFinger& other) {
      return scene_.KeepApart(placed, other);
    };
    return scene_.KeepsOffObject(placed, around_.pose, TipContact::kFree) &&
           std::ranges::all_of(around_.others, keeps_apart) && scene_.KeepsOffHand(placed);
  }
  /// Extend the tree by one stride from its nearest node towards a configuration.
  bool Extend(Tree& tree, const JointConfiguration& towards) const {
    const int nearest = tree.Nearest(towards);
    const JointConfiguration step = towards - tree.nodes[nearest];
    const double length = step.norm();
    if (length == 0) return false;
    const JointConfiguration next =
        length <= kStride ? towards
                          : JointConfiguration(tree.nodes[nearest] + (kStride / length) * step);
    // The end is checked first because most collisions occur there.
    if (!IsFreeAt(next) || !IsFree(tree.nodes[nearest], next)) return false;
    tree.nodes.push_back(next);
    tree.parents.push_back(nearest);
    return true;
  }
  FingerPath Shortened(FingerPath path) {
    for (int i = 0; i < kShortcuts && path.size() > 2; ++i) {
      const auto a = static_cast<std::ptrdiff_t>(random_.Index(path.size() - 2));
      const auto b = a + 2 + static_cast<std::ptrdiff_t>(random_.Index(path.size() - a - 2));
      if (IsFree(path[a], path[b])) path.erase(path.begin() + a + 1, path.begin() + b);
    }
    return path;
  }

  const HandScene& scene_;
  FingerIndex finger_;
  const Surroundings& around_;
  RandomStream& random_;
};

/// Return the directions for lifting a fingertip: the normal, then tilted ones.
std::vector<Eigen::Vector3d> LiftDirections(const Eigen::Vector3d& normal) {
  std::vector<Eigen::Vector3d> directions = {normal};
  const Eigen::Vector3d tilted =
      std::cos(kTiltedLift) * normal + std::sin(kTiltedLift) * normal.unitOrthogonal();
  for (int side = 0; side < kTiltedDirections; ++side) {
    directions.push_back(
        Eigen::AngleAxisd(2 * std::numbers::pi * side / kTiltedDirections, normal) * tilted);
  }
  return directions;
}

}  // namespace

bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
             const Touching& touching) {
  std::vector<bool> moves;
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    moves.push_back(
        scene.MotionBound(finger, from.configurations[finger], to.configurations[finger]) > 0);
  }
  const bool object_moves = from.pose.matrix() != to.pose.matrix();
  return CertifyOpen(scene, Stationary(moves.size(), nullptr), touching, from, to,
                     ChecksOf(moves, object_moves));
}

bool IsClear(const HandScene& scene, FingerIndex finger, const JointConfiguration& from,
             const JointConfiguration& to, const Eigen::Isometry3d& pose, TipContact tip,
             const std::vector<PlacedFinger>& others) {
  const int count = scene.finger_count();
  std::vector<bool> moves(count, false);
  moves[finger] = true;
  Stationary stationary(count, nullptr);
  for (const PlacedFinger& other : others) stationary[other.finger] = &other;
  Keyframe begin{pose, std::vector<JointConfiguration>(count)};
  Keyframe end = begin;
  begin.configurations[finger] = from;
  end.configurations[finger] = to;
  Touching touching(count, TipContact::kFree);
  touching[finger] = tip;
  return CertifyOpen(scene, stationary, touching, begin, end, ChecksOf(moves, false));
}

Surroundings AllExcept(const HandScene& scene, FingerIndex moving, const Keyframe& frame) {
  Surroundings around{frame.pose, {}};
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    if (finger != moving)
      around.others.push_back(scene.Place(finger, frame.configurations[finger]));
  }
  return around;
}

std::optional<FingerPath> FindFreePath(const HandScene& scene, FingerIndex finger,
                                       const JointConfiguration& from, const JointConfiguration& to,
                                       const Surroundings& around, RandomStream& random,
                                       int most_extensions) {
  return Connector(scene, finger, around, random).Find(from, to, most_extensions);
}

std::optional<FingerPath> FindLiftPath(const HandScene& scene,
                                       const kinematics::InverseKinematics& inverse,
                                       FingerIndex finger, const kinematics::TipTarget& target,
                                       const JointConfiguration& touching,
                                       const Surroundings& around) {
  for (const Eigen::Vector3d& direction : LiftDirections(-target.towards)) {
    FingerPath path = {touching};
    double height = 0;
    while (height < kMaxLift - kLiftStep / 2) {
      const kinematics::TipTarget above{target.centre + (height + kLiftStep) * direction,
                                        target.towards};
      const std::optional<JointConfiguration> next = inverse.SolveFrom(above, path.back());
      const TipContact tip = height < kTouchingLift ? TipContact::kTouching : TipContact::kFree;
      if (!next || !IsClear(scene, finger, path.back(), *next, tip, around)) break;
      path.push_back(*next);
      height += kLiftStep;
    }
    if (height > kMinLift - kLiftStep / 2) return path;
  }
  return std::nullopt;
}

std::optional<FingerPath> FindPathToContact(const HandScene& scene,
                                            const kinematics::InverseKinematics& inverse,
                                            FingerIndex finger, const JointConfiguration& from,
                                            const kinematics::TipTarget& target,
                                            const JointConfiguration& touching,
                                            const Surroundings& around, RandomStream& random) {
  const auto lift_path = FindLiftPath(scene, inverse, finger, target, touching, around);
  if (!lift_path) return std::nullopt;
  std::optional<FingerPath> path =
      FindFreePath(scene, finger, from, lift_path->back(), around, random);
  if (!path) return std::nullopt;
  path->insert(path->end(), lift_path->rbegin() + 1, lift_path->rend());
  return path;
}

}  // namespace regrasp::gait
