#include "planner/gait/finger_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

namespace {

constexpr double kStride = 0.35;  // radians, over all drives
constexpr int kShortcuts = 30;
/// Extensions after which a tree that has not grown at all is given up.
constexpr int kTrapped = 30;

/// Above the contact, metres: as high as the finger can go, but not lower than the first.
constexpr double kLowestAbove = 0.003;
constexpr double kHighestAbove = 0.020;
constexpr double kDescent = 0.002;  // between postures of the way down
/// So far from its contact a tip may be as near to the object as one that touches, metres; the
/// checker allows it (sim/hand/check_hand.cc) 2 mm more.
constexpr double kStillTouching = 0.010;
/// Where straight up is no way: so much off the normal, radians, to so many sides.
constexpr double kSideways = 0.8;
constexpr int kSides = 6;

/// Whether a finger's drives may go straight from a posture to another one.
bool IsClear(const HandScene& scene, FingerIndex finger, const Posture& from, const Posture& to,
             TipContact tip, const Surroundings& around) {
  return IsClear(scene, finger, from, to, around.pose, tip, around.others) &&
         (around.rolled.empty() ||
          IsClear(scene, finger, from, to, around.pose, tip, around.rolled));
}

struct Tree {
  std::vector<Posture> nodes;
  std::vector<int> parents;

  [[nodiscard]] bool IsRoot() const { return nodes.size() == 1; }

  int Nearest(const Posture& posture) const {
    int best = 0;
    for (int i = 1; i < static_cast<int>(nodes.size()); ++i) {
      if ((nodes[i] - posture).squaredNorm() < (nodes[best] - posture).squaredNorm()) best = i;
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

/// One finger that moves through its surroundings.
class Connector {
 public:
  Connector(const HandScene& scene, FingerIndex finger, const Surroundings& around,
            RandomStream& random)
      : scene_(scene), finger_(finger), around_(around), random_(random) {}

  std::optional<FingerPath> Find(const Posture& from, const Posture& to, int most_extensions) {
    if (IsFree(from, to)) return FingerPath{from, to};
    std::array<Tree, 2> trees = {Tree{{from}, {-1}}, Tree{{to}, {-1}}};
    for (int i = 0; i < most_extensions; ++i) {
      if (i == kTrapped && std::ranges::any_of(trees, &Tree::IsRoot)) break;
      Tree& growing = trees[i % 2];
      Tree& other = trees[1 - i % 2];
      if (!Extend(growing, scene_.DrawPosture(finger_, random_))) continue;
      const Posture reached = growing.nodes.back();
      // As far as it goes.
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
  [[nodiscard]] bool IsFree(const Posture& from, const Posture& to) const {
    return IsClear(scene_, finger_, from, to, TipContact::kFree, around_);
  }
  [[nodiscard]] bool IsFreeAt(const Posture& posture) const {
    const PlacedFinger placed = scene_.Place(finger_, posture);
    const auto keeps_apart = [&](const PlacedFinger& other) {
      return scene_.KeepApart(placed, other);
    };
    return scene_.KeepsOffObject(placed, around_.pose, TipContact::kFree) &&
           std::ranges::all_of(around_.others, keeps_apart) && scene_.KeepsOffHand(placed);
  }
  /// One stride from the tree's nearest node towards a posture.
  bool Extend(Tree& tree, const Posture& towards) const {
    const int nearest = tree.Nearest(towards);
    const Posture step = towards - tree.nodes[nearest];
    const double length = step.norm();
    if (length == 0) return false;
    const Posture next =
        length <= kStride ? towards : Posture(tree.nodes[nearest] + (kStride / length) * step);
    // Mostly it is at its end that a stride runs into something.
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

/// Directions to leave a surface in: along its normal, or else to one of the sides.
std::vector<Eigen::Vector3d> WaysOff(const Eigen::Vector3d& normal) {
  std::vector<Eigen::Vector3d> ways = {normal};
  const Eigen::Vector3d aslant =
      std::cos(kSideways) * normal + std::sin(kSideways) * normal.unitOrthogonal();
  for (int side = 0; side < kSides; ++side) {
    ways.push_back(Eigen::AngleAxisd(2 * std::numbers::pi * side / kSides, normal) * aslant);
  }
  return ways;
}

}  // namespace

Surroundings AllBut(const HandScene& scene, FingerIndex moving, const Keyframe& frame) {
  Surroundings around{frame.pose, {}};
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    if (finger != moving) around.others.push_back(scene.Place(finger, frame.postures[finger]));
  }
  return around;
}

std::optional<FingerPath> FindFreePath(const HandScene& scene, FingerIndex finger,
                                       const Posture& from, const Posture& to,
                                       const Surroundings& around, RandomStream& random,
                                       int most_extensions) {
  return Connector(scene, finger, around, random).Find(from, to, most_extensions);
}

std::optional<FingerPath> FindLiftPath(const HandScene& scene,
                                       const kinematics::InverseKinematics& inverse,
                                       FingerIndex finger, const kinematics::TipTarget& target,
                                       const Posture& touching, const Surroundings& around) {
  for (const Eigen::Vector3d& up : WaysOff(-target.towards)) {
    FingerPath path = {touching};
    double height = 0;
    while (height < kHighestAbove - kDescent / 2) {
      const kinematics::TipTarget above{target.centre + (height + kDescent) * up, target.towards};
      const std::optional<Posture> next = inverse.SolveFrom(above, path.back());
      const TipContact tip = height < kStillTouching ? TipContact::kTouching : TipContact::kFree;
      if (!next || !IsClear(scene, finger, path.back(), *next, tip, around)) break;
      path.push_back(*next);
      height += kDescent;
    }
    if (height > kLowestAbove - kDescent / 2) return path;
  }
  return std::nullopt;
}

std::optional<FingerPath> FindPathToContact(const HandScene& scene,
                                            const kinematics::InverseKinematics& inverse,
                                            FingerIndex finger, const Posture& from,
                                            const kinematics::TipTarget& target,
                                            const Posture& touching, const Surroundings& around,
                                            RandomStream& random) {
  const auto up = FindLiftPath(scene, inverse, finger, target, touching, around);
  if (!up) return std::nullopt;
  std::optional<FingerPath> path = FindFreePath(scene, finger, from, up->back(), around, random);
  if (!path) return std::nullopt;
  path->insert(path->end(), up->rbegin() + 1, up->rend());
  return path;
}

}  // namespace regrasp::gait
