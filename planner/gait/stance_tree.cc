#include "planner/gait/stance_tree.h"

#include <algorithm>

#include "planner/gait/object_motion.h"

namespace regrasp::gait {

namespace {

/// Nodes from which a hold is carried on in vain.
constexpr int kPatience = 40;
/// Of one move: times that it is led round what it can't pass.
constexpr int kMostDetours = 8;

}  // namespace

int StanceTree::Add(StanceNode rest) {
  rests_.push_back(std::move(rest));
  return static_cast<int>(rests_.size()) - 1;
}

int StanceTree::RootOf(int rest) const {
  while (rests_[rest].parent >= 0) rest = rests_[rest].parent;
  return rest;
}

StanceNode StanceTree::After(int from, const ContactAssignment& to, int node) const {
  const StanceNode& before = rests_[from];
  const Change change = ChangeBetween(before.hold.holding, to);
  StanceNode rest{.hold = {to, before.hold.waiting},
                  .node = node,
                  .parent = from,
                  .slides = before.slides + static_cast<int>(!change.slid.empty())};
  if (change.placed.valid()) rest.hold.waiting[change.placed] = {};
  return rest;
}

void StanceTree::ExtendReachable(StanceNode& rest) {
  rest.carried = checker_.ExtendAround(
      rest.hold, rest.node, kPatience * (1 + rest.turns),
      [&](int node) { return is_enough_(node, rest.hold.holding); }, rest.blocked);
}

const std::vector<Keyframe>* StanceTree::MoveBetween(StanceNode& rest, int from, int to) {
  const auto [found, is_new] = rest.moves.try_emplace({from, to});
  if (is_new && !rest.blocked.contains(std::minmax({from, to}))) {
    const Keyframe first = from == rest.node ? rest.at : checker_.FrameAt(rest.hold, from);
    if (auto move = FindMove(setup_, rest.hold.holding, first, checker_.FrameAt(rest.hold, to))) {
      found->second = *std::move(move);
    }
  }
  return found->second.empty() ? nullptr : &found->second;
}

std::optional<std::vector<Keyframe>> StanceTree::MoveFrom(StanceNode& rest, int node) {
  for (int detour = 0; rest.carried.from.contains(node); ++detour) {
    const std::vector<int> path = rest.carried.PathTo(node);
    std::vector<Keyframe> keyframes = {rest.at};
    std::size_t at = 1;
    while (at < path.size()) {
      const std::vector<Keyframe>* move = MoveBetween(rest, path[at - 1], path[at]);
      if (move == nullptr) break;
      keyframes.insert(keyframes.end(), move->begin() + 1, move->end());
      ++at;
    }
    if (at == path.size()) return keyframes;
    rest.blocked.insert(std::minmax({path[at - 1], path[at]}));
    // Tips that roll were followed along this way.
    if (detour == kMostDetours || setup_.rolled_on != nullptr) break;
    ExtendReachable(rest);
  }
  ++counts_.no_move;
  return std::nullopt;
}

bool StanceTree::PlanPathFromParent(StanceNode& rest) {
  rest.at = checker_.FrameAt(rest.hold, rest.node);
  if (rest.parent < 0) return true;
  const Stance& before = rests_[rest.parent].hold;
  auto way = paths_.Find(before, rest.hold, rest.node, {rest.rolled_before, rest.rolled});
  if (!way) {
    const bool slides = !ChangeBetween(before.holding, rest.hold.holding).slid.empty();
    ++(slides ? counts_.no_slide : counts_.no_path);
    return false;
  }
  rest.way = *std::move(way);
  rest.at = rest.way.back().path.back();
  return true;
}

void StanceTree::IdleAsBefore(StanceNode& rest) const {
  if (rest.parent < 0) return;
  const Stance& before = rests_[rest.parent].hold;
  for (std::size_t finger = 0; finger < before.holding.size(); ++finger) {
    if (before.holding[finger] == kNone && rest.hold.holding[finger] == kNone) {
      rest.hold.waiting[finger] = before.waiting[finger];
    }
  }
}

int StanceTree::WithIdlePosture(int index, FingerIndex finger, const Posture& posture) {
  std::vector<int> chain;
  int last = index;
  while (last >= 0 && rests_[last].hold.holding[finger] == kNone) {
    chain.push_back(last);
    last = rests_[last].parent;
  }
  if (chain.empty() || (last < 0 && !has_given_start_)) return -1;
  std::ranges::reverse(chain);
  for (const int i : chain) {
    StanceNode rest = rests_[i];
    rest.parent = last;
    rest.way.clear();
    rest.is_carried = false;
    rest.ends_in_vain = false;
    rest.farthest = std::numeric_limits<int>::max();
    rest.moves.clear();
    rest.blocked.clear();
    IdleAsBefore(rest);
    rest.hold.waiting[finger] = posture;
    const bool is_free = checker_.IsPassable(rest.hold, rest.node) && PlanPathFromParent(rest) &&
                         rest.hold.waiting[finger] == posture;
    if (!is_free) return -1;
    last = Add(std::move(rest));
  }
  return last;
}

int StanceTree::AfterIdlingAbove(int index) {
  const int parent = rests_[index].parent;
  const Stance& before = rests_[parent].hold;
  const FingerIndex placed = ChangeBetween(before.holding, rests_[index].hold.holding).placed;
  if (!placed.valid()) return -1;
  Stance above = before;
  const int point = rests_[index].hold.holding[placed];
  if (!checker_.IdleAbove(above, placed, point, rests_[index].node)) return -1;
  const int begin = WithIdlePosture(parent, placed, above.waiting[placed]);
  if (begin < 0) return -1;
  StanceNode rest = rests_[index];
  rest.parent = begin;
  IdleAsBefore(rest);
  if (!PlanPathFromParent(rest)) return -1;
  return Add(std::move(rest));
}

int StanceTree::LastExecuted(int rest) const {
  while (rest >= 0 && !rests_[rest].is_carried) rest = rests_[rest].parent;
  return rest;
}

void StanceTree::MarkExecuted(int rest) {
  for (; rest >= 0; rest = rests_[rest].parent) rests_[rest].is_carried = true;
}

int StanceTree::CutOffAfter(int index, int changes) {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = rests_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  int come_to = -1;
  for (const int i : chain) {
    come_to = rests_[i].parent < 0 ? 0 : come_to + static_cast<int>(rests_[i].way.size());
    if (come_to <= changes) continue;
    CutOff(i);
    return i;
  }
  return -1;
}

void StanceTree::LimitBefore(int index, int step) {
  rests_[index].farthest = std::min(rests_[index].farthest, step);
  for (int i = index; i < size(); ++i) {
    const StanceNode& rest = rests_[i];
    if (rest.parent == index && grid_.StepOf(rest.node) > step && !rest.is_carried) CutOff(i);
  }
}

void StanceTree::CutOff(int index) {
  rests_[index].is_cut_off = true;
  // A rest comes after its parent.
  for (int i = index; i < size(); ++i) {
    StanceNode& rest = rests_[i];
    rest.is_cut_off = rest.is_cut_off || (rest.parent >= 0 && rests_[rest.parent].is_cut_off);
  }
}

std::optional<Gait> StanceTree::PathTo(int index, int node) {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = rests_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  Gait gait{rests_[chain.front()].hold.holding, rests_[chain.front()].at, {}};
  const auto move_to = [&](StanceNode& rest, int to) {
    if (rest.node == to) return true;
    auto move = MoveFrom(rest, to);
    if (move) gait.segments.push_back({PlanSegment::Kind::kMove, {}, kNone, *std::move(move)});
    return move.has_value();
  };
  for (const int i : chain) {
    StanceNode& rest = rests_[i];
    if (rest.parent >= 0 && !move_to(rests_[rest.parent], rest.node)) {
      CutOff(i);
      return std::nullopt;
    }
    gait.segments.insert(gait.segments.end(), rest.way.begin(), rest.way.end());
  }
  if (!move_to(rests_[index], node)) return std::nullopt;
  return gait;
}

}  // namespace regrasp::gait
