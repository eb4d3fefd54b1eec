#include "planner/gait/object_motion.h"

#include <algorithm>
#include <array>
#include <queue>
#include <set>
#include <tuple>

#include "planner/gait/finger_path.h"

namespace regrasp::gait {

namespace {

/// Maximum number of bisections between two keyframes.
constexpr int kMaxBisections = 6;

/// Recursive construction of one in-hand motion.
class MotionBuilder {
 public:
  MotionBuilder(const HandSetup& setup, const ContactAssignment& assignment)
      : setup_(setup), assignment_(assignment) {
    for (const int point : assignment) {
      touching_.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
    }
  }

  /// Append the keyframes of the motion without the first.
  /// @returns whether the motion is feasible.
  [[nodiscard]] bool Append(const Keyframe& from, const Keyframe& to, int bisections,
                            std::vector<Keyframe>& path) const {
    const Keyframe middle = Between(from, to, 0.5);
    if (TipsAreOnContacts(middle)) {
      if (!IsClear(setup_.scene, from, to, touching_)) return false;
      path.push_back(to);
      return true;
    }
    if (bisections == 0) return false;
    const auto held = Projected(middle);
    return held && Append(from, *held, bisections - 1, path) &&
           Append(*held, to, bisections - 1, path);
  }

 private:
  [[nodiscard]] kinematics::TipTarget TargetOf(FingerIndex finger, const Keyframe& frame) const {
    return TargetAt(setup_.scene.finger(finger), setup_.points[assignment_[finger]], frame.pose);
  }
  [[nodiscard]] bool TipsAreOnContacts(const Keyframe& frame) const {
    for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
      if (assignment_[finger] == kNone) continue;
      const Eigen::Vector3d centre =
          kinematics::TipAt(setup_.scene.finger(finger), frame.configurations[finger]).centre;
      if ((centre - TargetOf(finger, frame).centre).norm() > kTipOff) return false;
    }
    return true;
  }
  /// Return the nearest keyframe with all fingertips on their contacts.
  [[nodiscard]] std::optional<Keyframe> Projected(Keyframe frame) const {
    for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
      if (assignment_[finger] == kNone) continue;
      JointConfiguration& configuration = frame.configurations[finger];
      const auto held = setup_.inverse[finger].SolveNear(TargetOf(finger, frame), configuration);
      if (!held) return std::nullopt;
      configuration = *held;
    }
    return frame;
  }

  const HandSetup& setup_;
  const ContactAssignment& assignment_;
  Touching touching_;
};

/// Random idle configurations: draws per finger, and attempts for all fingers together.
constexpr int kIdleDraws = 200;
constexpr int kIdleAttempts = 10;
/// Heights above a former contact at which a finger may idle, metres.
constexpr std::array kIdleHeights = {0.020, 0.012, 0.006};

}  // namespace

std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup,
                                              const ContactAssignment& assignment,
                                              const Keyframe& from, const Keyframe& to) {
  std::vector<Keyframe> path = {from};
  if (!MotionBuilder(setup, assignment).Append(from, to, kMaxBisections, path)) return std::nullopt;
  return path;
}

Keyframe ObjectMotionChecker::FrameAt(const Stance& stance, int node) {
  Keyframe frame{grid_.PoseAt(node), stance.idle};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (stance.assignment[finger] == kNone) continue;
    frame.configurations[finger] = *reach_.Find(finger, stance.assignment[finger], node);
  }
  return frame;
}

bool ObjectMotionChecker::KeepsOffPalm(int node) {
  const auto [found, is_new] = off_palm_.try_emplace(node);
  if (is_new) found->second = setup_.scene.KeepsOffPalm(grid_.PoseAt(node));
  return found->second;
}

bool ObjectMotionChecker::KeepApart(const Stance& stance, FingerIndex a, FingerIndex b, int node) {
  const auto points = setup_.points.size();
  const auto fingers = static_cast<std::size_t>(setup_.scene.finger_count());
  std::size_t key = static_cast<std::size_t>(node);
  for (const FingerIndex finger : {a, b}) {
    key = (key * fingers + static_cast<std::size_t>(finger)) * points +
          static_cast<std::size_t>(stance.assignment[finger]);
  }
  const auto [found, is_new] = apart_.try_emplace(key);
  if (is_new) {
    found->second =
        setup_.scene.KeepApart(setup_.scene.Place(a, *reach_.Find(a, stance.assignment[a], node)),
                               setup_.scene.Place(b, *reach_.Find(b, stance.assignment[b], node)));
  }
  return found->second;
}

bool ObjectMotionChecker::KeepsApart(const Stance& stance, FingerIndex finger, int node) {
  for (FingerIndex other{0}; other < setup_.scene.finger_count(); ++other) {
    if (other == finger || stance.assignment[other] == kNone) continue;
    if (!KeepApart(stance, std::min(finger, other), std::max(finger, other), node)) return false;
  }
  return true;
}

bool ObjectMotionChecker::IsPassable(const Stance& stance, int node) {
  if (!KeepsOffPalm(node)) return false;
  if (supported_ != nullptr && !supported_->Holds(stance.assignment, node)) return false;
  std::vector<FingerIndex> holding_fingers;
  std::vector<FingerIndex> idle_fingers;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (stance.assignment[finger] != kNone) {
      holding_fingers.push_back(finger);
    } else if (finger < std::ssize(stance.idle) && stance.idle[finger].size() > 0) {
      idle_fingers.push_back(finger);
    }
  }
  for (std::size_t b = 1; b < holding_fingers.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (!KeepApart(stance, holding_fingers[a], holding_fingers[b], node)) return false;
    }
  }
  if (idle_fingers.empty()) return true;
  std::vector<PlacedFinger> placed;
  for (const FingerIndex finger : holding_fingers) {
    placed.push_back(
        setup_.scene.Place(finger, *reach_.Find(finger, stance.assignment[finger], node)));
  }
  const Eigen::Isometry3d pose = grid_.PoseAt(node);
  for (const FingerIndex finger : idle_fingers) {
    PlacedFinger idle_finger = setup_.scene.Place(finger, stance.idle[finger]);
    const auto keeps_apart = [&](const PlacedFinger& other) {
      return setup_.scene.KeepApart(other, idle_finger);
    };
    if (!setup_.scene.KeepsOffObject(idle_finger, pose, TipContact::kFree) ||
        !std::ranges::all_of(placed, keeps_apart)) {
      return false;
    }
    placed.push_back(std::move(idle_finger));
  }
  return true;
}

std::optional<JointConfiguration> ObjectMotionChecker::ConfigurationAbove(FingerIndex finger,
                                                                          int point, int node,
                                                                          double height) {
  const JointConfiguration* touching = reach_.Find(finger, point, node);
  if (touching == nullptr) return std::nullopt;
  kinematics::TipTarget target =
      TargetAt(setup_.scene.finger(finger), setup_.points[point], grid_.PoseAt(node));
  target.centre -= height * target.towards;
  auto above = setup_.inverse[finger].SolveFrom(target, *touching);
  if (above && !setup_.scene.KeepsOffHand(setup_.scene.Place(finger, *above))) above.reset();
  return above;
}

bool ObjectMotionChecker::DrawIdleConfigurations(Stance& stance, int node, RandomStream& random) {
  for (const int drawn : random.Choose(setup_.scene.finger_count(), setup_.scene.finger_count())) {
    const FingerIndex finger{drawn};
    if (stance.assignment[finger] != kNone || stance.idle[finger].size() > 0) continue;
    bool is_placed = false;
    for (int i = 0; !is_placed && i < kIdleDraws; ++i) {
      stance.idle[finger] = setup_.scene.DrawConfiguration(finger, random);
      is_placed = setup_.scene.KeepsOffHand(setup_.scene.Place(finger, stance.idle[finger])) &&
                  IsPassable(stance, node);
    }
    if (!is_placed) return false;
  }
  return true;
}

bool ObjectMotionChecker::PlaceIdleFingers(Stance& stance, int node, RandomStream* random,
                                           const Stance* before) {
  stance.idle.resize(setup_.scene.finger_count());
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (stance.assignment[finger] == kNone) continue;
    if (reach_.Find(finger, stance.assignment[finger], node) == nullptr) return false;
  }
  if (!IsPassable(stance, node)) return false;
  const std::vector<JointConfiguration> given = stance.idle;
  if (UseIdleConfigurations(stance, node, before)) return true;
  for (int i = 0; random != nullptr && i < kIdleAttempts; ++i) {
    stance.idle = given;
    if (DrawIdleConfigurations(stance, node, *random)) return true;
  }
  return false;
}

bool ObjectMotionChecker::IdleAbove(Stance& stance, FingerIndex finger, int point, int node) {
  for (const double height : kIdleHeights) {
    const auto above = ConfigurationAbove(finger, point, node, height);
    if (!above) continue;
    stance.idle[finger] = *above;
    if (IsPassable(stance, node)) return true;
  }
  return false;
}

bool ObjectMotionChecker::UseIdleConfigurations(Stance& stance, int node, const Stance* before) {
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (stance.assignment[finger] != kNone || stance.idle[finger].size() > 0) continue;
    const auto fits = [&](const JointConfiguration& configuration) {
      stance.idle[finger] = configuration;
      return IsPassable(stance, node);
    };
    bool is_placed = std::ranges::any_of(idle_configurations_[finger], fits);
    // The finger may stay a few millimetres above its former contact.
    const bool has_held = before != nullptr && before->assignment[finger] != kNone;
    if (!is_placed && !(has_held && IdleAbove(stance, finger, before->assignment[finger], node))) {
      return false;
    }
  }
  return true;
}

bool ObjectMotionChecker::CanFollow(const Stance& stance, int node, int neighbour) {
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (stance.assignment[finger] == kNone) continue;
    if (!reach_.CanFollow(finger, stance.assignment[finger], node, neighbour)) return false;
  }
  return true;
}

ReachablePoses ObjectMotionChecker::ExtendAlongTrack(const Stance& stance, int node) {
  ReachablePoses reachable{{{node, node}}, node};
  for (int next = grid_.Onward(node); next != PoseGrid::kNoNode; next = grid_.Onward(next)) {
    if (!CanFollow(stance, reachable.end, next) || !IsPassable(stance, next)) break;
    reachable.predecessor.emplace(next, reachable.end);
    reachable.end = next;
  }
  return reachable;
}

ReachablePoses ObjectMotionChecker::ExtendAround(const Stance& stance, int node, int patience,
                                                 const std::function<bool(int)>& is_enough,
                                                 const GridEdges& blocked) {
  using Key = std::tuple<int, bool, int, int>;  // step, is goal, −offset units, −insertion order
  const auto key_of = [&](int at, int order) {
    return Key(grid_.StepOf(at), grid_.IsGoal(at), -grid_.OffTrack(at), -order);
  };
  std::priority_queue<std::pair<Key, int>> queue;
  ReachablePoses reachable{{{node, node}}, node};
  std::set<int> visited = {node};
  queue.push({key_of(node, 0), node});
  std::pair<Key, int> best = queue.top();
  int without_progress = 0;
  while (!queue.empty() && without_progress < patience) {
    const auto top = queue.top();
    queue.pop();
    if (best.first < top.first) {
      best = top;
    } else {
      ++without_progress;
    }
    if (is_enough(best.second)) break;
    for (const int next : grid_.Neighbours(top.second)) {
      if (visited.contains(next) || blocked.contains(std::minmax({top.second, next})) ||
          !CanFollow(stance, top.second, next)) {
        continue;
      }
      visited.insert(next);
      if (!IsPassable(stance, next)) continue;
      reachable.predecessor.emplace(next, top.second);
      queue.push({key_of(next, static_cast<int>(visited.size())), next});
    }
  }
  reachable.end = best.second;
  return reachable;
}

std::vector<int> ReachablePoses::PathTo(int node) const {
  std::vector<int> path = {node};
  while (predecessor.at(path.back()) != path.back()) path.push_back(predecessor.at(path.back()));
  std::ranges::reverse(path);
  return path;
}

}  // namespace regrasp::gait
