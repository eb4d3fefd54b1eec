#include "planner/gait/finger_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/gait/certified_path.h"

namespace regrasp::gait {
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

std::optional<FingerPath> FindWayUp(const HandScene& scene,
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
  const auto up = FindWayUp(scene, inverse, finger, target, touching, around);
  if (!up) return std::nullopt;
  std::optional<FingerPath> path = FindFreePath(scene, finger, from, up->back(), around, random);
  if (!path) return std::nullopt;
  path->insert(path->end(), up->rbegin() + 1, up->rend());
  return path;
}

}  // namespace regrasp::gait
