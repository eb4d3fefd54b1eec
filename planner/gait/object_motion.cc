#include "planner/gait/object_motion.h"

#include <algorithm>
#include <array>
#include <queue>
#include <set>
#include <tuple>

#include "planner/gait/finger_path.h"

namespace regrasp::gait {

namespace {

/// Halvings of the way between two keyframes.
constexpr int kMostHalvings = 6;

/// One move.
class Mover {
 public:
  Mover(const HandSetup& setup, const ContactAssignment& holding)
      : setup_(setup), holding_(holding) {
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
  const ContactAssignment& holding_;
  Touching touching_;
};

}  // namespace

std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup,
                                              const ContactAssignment& holding,
                                              const Keyframe& from, const Keyframe& to) {
  std::vector<Keyframe> path = {from};
  if (!Mover(setup, holding).Append(from, to, kMostHalvings, path)) return std::nullopt;
  return path;
}

namespace {

/// To wait in, for a finger where the usual places don't suit all; times that all are drawn.
constexpr int kDrawnPlaces = 200;
constexpr int kDrawings = 10;
/// Above a contact that a finger has left, where it may wait too, metres: the highest first.
constexpr std::array kHeights = {0.020, 0.012, 0.006};

}  // namespace

Keyframe ObjectMotionChecker::FrameAt(const Stance& hold, int node) {
  Keyframe frame{grid_.PoseAt(node), hold.waiting};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    frame.postures[finger] = *reach_.Find(finger, hold.holding[finger], node);
  }
  return frame;
}

bool ObjectMotionChecker::KeepsOffPalm(int node) {
  const auto [found, is_new] = off_palm_.try_emplace(node);
  if (is_new) found->second = setup_.scene.KeepsOffPalm(grid_.PoseAt(node));
  return found->second;
}

bool ObjectMotionChecker::KeepApart(const Stance& hold, FingerIndex a, FingerIndex b, int node) {
  const auto points = setup_.points.size();
  const auto fingers = static_cast<std::size_t>(setup_.scene.finger_count());
  std::size_t key = static_cast<std::size_t>(node);
  for (const FingerIndex finger : {a, b}) {
    key = (key * fingers + static_cast<std::size_t>(finger)) * points +
          static_cast<std::size_t>(hold.holding[finger]);
  }
  const auto [found, is_new] = apart_.try_emplace(key);
  if (is_new) {
    found->second =
        setup_.scene.KeepApart(setup_.scene.Place(a, *reach_.Find(a, hold.holding[a], node)),
                               setup_.scene.Place(b, *reach_.Find(b, hold.holding[b], node)));
  }
  return found->second;
}

bool ObjectMotionChecker::KeepsApart(const Stance& hold, FingerIndex finger, int node) {
  for (FingerIndex other{0}; other < setup_.scene.finger_count(); ++other) {
    if (other == finger || hold.holding[other] == kNone) continue;
    if (!KeepApart(hold, std::min(finger, other), std::max(finger, other), node)) return false;
  }
  return true;
}

bool ObjectMotionChecker::IsPassable(const Stance& hold, int node) {
  if (!KeepsOffPalm(node)) return false;
  std::vector<FingerIndex> holding;
  std::vector<FingerIndex> waiting;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] != kNone) {
      holding.push_back(finger);
    } else if (finger < std::ssize(hold.waiting) && hold.waiting[finger].size() > 0) {
      waiting.push_back(finger);
    }
  }
  for (std::size_t b = 1; b < holding.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (!KeepApart(hold, holding[a], holding[b], node)) return false;
    }
  }
  if (waiting.empty()) return true;
  std::vector<PlacedFinger> placed;
  for (const FingerIndex finger : holding) {
    placed.push_back(setup_.scene.Place(finger, *reach_.Find(finger, hold.holding[finger], node)));
  }
  const Eigen::Isometry3d pose = grid_.PoseAt(node);
  for (const FingerIndex finger : waiting) {
    PlacedFinger there = setup_.scene.Place(finger, hold.waiting[finger]);
    const auto keeps_apart = [&](const PlacedFinger& other) {
      return setup_.scene.KeepApart(other, there);
    };
    if (!setup_.scene.KeepsOffObject(there, pose, TipContact::kFree) ||
        !std::ranges::all_of(placed, keeps_apart)) {
      return false;
    }
    placed.push_back(std::move(there));
  }
  return true;
}

std::optional<Posture> ObjectMotionChecker::PostureAbove(FingerIndex finger, int point, int node,
                                                         double height) {
  const Posture* touching = reach_.Find(finger, point, node);
  if (touching == nullptr) return std::nullopt;
  kinematics::TipTarget target =
      TargetAt(setup_.scene.finger(finger), setup_.points[point], grid_.PoseAt(node));
  target.centre -= height * target.towards;
  auto above = setup_.inverse[finger].SolveFrom(target, *touching);
  if (above && !setup_.scene.KeepsOffHand(setup_.scene.Place(finger, *above))) above.reset();
  return above;
}

bool ObjectMotionChecker::DrawIdlePostures(Stance& hold, int node, RandomStream& random) {
  for (const int drawn : random.Choose(setup_.scene.finger_count(), setup_.scene.finger_count())) {
    const FingerIndex finger{drawn};
    if (hold.holding[finger] != kNone || hold.waiting[finger].size() > 0) continue;
    bool waits = false;
    for (int i = 0; !waits && i < kDrawnPlaces; ++i) {
      hold.waiting[finger] = setup_.scene.DrawPosture(finger, random);
      waits = setup_.scene.KeepsOffHand(setup_.scene.Place(finger, hold.waiting[finger])) &&
              IsPassable(hold, node);
    }
    if (!waits) return false;
  }
  return true;
}

bool ObjectMotionChecker::PlaceIdleFingers(Stance& hold, int node, RandomStream* random,
                                           const Stance* before) {
  hold.waiting.resize(setup_.scene.finger_count());
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    if (reach_.Find(finger, hold.holding[finger], node) == nullptr) return false;
  }
  if (!IsPassable(hold, node)) return false;
  const std::vector<Posture> given = hold.waiting;
  if (UseIdlePostures(hold, node, before)) return true;
  for (int i = 0; random != nullptr && i < kDrawings; ++i) {
    hold.waiting = given;
    if (DrawIdlePostures(hold, node, *random)) return true;
  }
  return false;
}

bool ObjectMotionChecker::IdleAbove(Stance& hold, FingerIndex finger, int point, int node) {
  for (const double height : kHeights) {
    const auto above = PostureAbove(finger, point, node, height);
    if (!above) continue;
    hold.waiting[finger] = *above;
    if (IsPassable(hold, node)) return true;
  }
  return false;
}

bool ObjectMotionChecker::UseIdlePostures(Stance& hold, int node, const Stance* before) {
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] != kNone || hold.waiting[finger].size() > 0) continue;
    const auto waits_at = [&](const Posture& posture) {
      hold.waiting[finger] = posture;
      return IsPassable(hold, node);
    };
    bool waits = std::ranges::any_of(idle_postures_[finger], waits_at);
    // Where it was, some millimetres above its contact.
    const bool has_held = before != nullptr && before->holding[finger] != kNone;
    if (!waits && !(has_held && IdleAbove(hold, finger, before->holding[finger], node))) {
      return false;
    }
  }
  return true;
}

bool ObjectMotionChecker::CanFollow(const Stance& hold, int node, int neighbour) {
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    if (!reach_.CanFollow(finger, hold.holding[finger], node, neighbour)) return false;
  }
  return true;
}

ReachablePoses ObjectMotionChecker::ExtendAlongTrack(const Stance& hold, int node) {
  ReachablePoses carried{{{node, node}}, node};
  for (int next = grid_.Onward(node); next != PoseGrid::kNoNode; next = grid_.Onward(next)) {
    if (!CanFollow(hold, carried.end, next) || !IsPassable(hold, next)) break;
    carried.from.emplace(next, carried.end);
    carried.end = next;
  }
  return carried;
}

ReachablePoses ObjectMotionChecker::ExtendAround(const Stance& hold, int node, int patience,
                                                 const std::function<bool(int)>& is_enough,
                                                 const GridEdges& blocked) {
  using Key = std::tuple<int, bool, int, int>;  // step, is goal, units beside the track, order
  const auto key_of = [&](int at, int order) {
    return Key(grid_.StepOf(at), grid_.IsGoal(at), -grid_.OffTrack(at), -order);
  };
  std::priority_queue<std::pair<Key, int>> queue;
  ReachablePoses carried{{{node, node}}, node};
  std::set<int> tried = {node};
  queue.push({key_of(node, 0), node});
  std::pair<Key, int> best = queue.top();
  int in_vain = 0;
  while (!queue.empty() && in_vain < patience) {
    const auto top = queue.top();
    queue.pop();
    if (best.first < top.first) {
      best = top;
    } else {
      ++in_vain;
    }
    if (is_enough(best.second)) break;
    for (const int next : grid_.Neighbours(top.second)) {
      if (tried.contains(next) || blocked.contains(std::minmax({top.second, next})) ||
          !CanFollow(hold, top.second, next)) {
        continue;
      }
      tried.insert(next);
      if (!IsPassable(hold, next)) continue;
      carried.from.emplace(next, top.second);
      queue.push({key_of(next, static_cast<int>(tried.size())), next});
    }
  }
  carried.end = best.second;
  return carried;
}

std::vector<int> ReachablePoses::PathTo(int node) const {
  std::vector<int> path = {node};
  while (from.at(path.back()) != path.back()) path.push_back(from.at(path.back()));
  std::ranges::reverse(path);
  return path;
}

}  // namespace regrasp::gait
