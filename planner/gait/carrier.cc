#include "planner/gait/carrier.h"

#include <algorithm>
#include <array>
#include <queue>
#include <set>
#include <tuple>

namespace regrasp::gait {
namespace {

/// To wait in, for a finger that none of the usual places suits.
constexpr int kDrawnPlaces = 1000;
/// Above a contact that a finger has left, where it may wait too, metres: the highest first.
constexpr std::array kHeights = {0.020, 0.012, 0.006};

}  // namespace

Keyframe Carrier::FrameAt(const Hold& hold, int node) {
  Keyframe frame{grid_.PoseAt(node), hold.waiting};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    frame.postures[finger] = *reach_.Find(finger, hold.holding[finger], node);
  }
  return frame;
}

bool Carrier::IsPassable(const Hold& hold, int node) {
  const Keyframe frame = FrameAt(hold, node);
  if (!setup_.scene.KeepsOffPalm(frame.pose)) return false;
  std::vector<PlacedFinger> placed;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (frame.postures[finger].size() == 0) continue;
    placed.push_back(setup_.scene.Place(finger, frame.postures[finger]));
    for (std::size_t other = 0; other + 1 < placed.size(); ++other) {
      if (!setup_.scene.KeepApart(placed[other], placed.back())) return false;
    }
    if (hold.holding[finger] == kNone &&
        !setup_.scene.KeepsOffObject(placed.back(), frame.pose, TipContact::kFree)) {
      return false;
    }
  }
  return true;
}

std::optional<Posture> Carrier::PostureAbove(FingerIndex finger, int point, int node,
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

bool Carrier::LetFreeFingersWait(Hold& hold, int node, RandomStream* random, const Hold* before) {
  hold.waiting.resize(setup_.scene.finger_count());
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    if (reach_.Find(finger, hold.holding[finger], node) == nullptr) return false;
  }
  if (!IsPassable(hold, node)) return false;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] != kNone || hold.waiting[finger].size() > 0) continue;
    const auto waits_at = [&](const Posture& posture) {
      hold.waiting[finger] = posture;
      return IsPassable(hold, node);
    };
    bool waits = std::ranges::any_of(parking_[finger], waits_at);
    for (int i = 0; !waits && random != nullptr && i < kDrawnPlaces; ++i) {
      const Posture drawn = setup_.scene.DrawPosture(finger, *random);
      waits = setup_.scene.KeepsOffHand(setup_.scene.Place(finger, drawn)) && waits_at(drawn);
    }
    // Where it was, some millimetres above its contact.
    for (const double height : kHeights) {
      if (waits || before == nullptr || before->holding[finger] == kNone) break;
      const auto above = PostureAbove(finger, before->holding[finger], node, height);
      waits = above && waits_at(*above);
    }
    if (!waits) return false;
  }
  return true;
}

bool Carrier::CanFollow(const Hold& hold, int node, int neighbour) {
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (hold.holding[finger] == kNone) continue;
    if (!reach_.CanFollow(finger, hold.holding[finger], node, neighbour)) return false;
  }
  return true;
}

Carried Carrier::StraightOn(const Hold& hold, int node) {
  Carried carried{{{node, node}}, node};
  for (int next = grid_.Onward(node); next != PoseGrid::kNoNode; next = grid_.Onward(next)) {
    if (!CanFollow(hold, carried.end, next) || !IsPassable(hold, next)) break;
    carried.from.emplace(next, carried.end);
    carried.end = next;
  }
  return carried;
}

Carried Carrier::Around(const Hold& hold, int node, int patience,
                        const std::function<bool(int)>& is_enough, const Legs& barred) {
  using Key = std::tuple<int, bool, int, int>;  // step, is goal, units beside the track, order
  const auto key_of = [&](int at, int order) {
    return Key(grid_.StepOf(at), grid_.IsGoal(at), -grid_.OffTrack(at), -order);
  };
  std::priority_queue<std::pair<Key, int>> queue;
  Carried carried{{{node, node}}, node};
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
      if (tried.contains(next) || barred.contains(std::minmax({top.second, next})) ||
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

std::vector<int> Carried::PathTo(int node) const {
  std::vector<int> path = {node};
  while (from.at(path.back()) != path.back()) path.push_back(from.at(path.back()));
  std::ranges::reverse(path);
  return path;
}

}  // namespace regrasp::gait
