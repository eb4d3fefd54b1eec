#include "planner/gait/stance_tree.h"

#include <algorithm>

#include "planner/gait/object_motion.h"

namespace regrasp::gait {

namespace {

/// Expanded grid nodes without progress after which an extension stops.
constexpr int kPatience = 40;
/// Maximum number of detours per in-hand motion.
constexpr int kMaxDetours = 8;

}  // namespace

int StanceTree::Add(StanceNode stance_node) {
  nodes_.push_back(std::move(stance_node));
  return static_cast<int>(nodes_.size()) - 1;
}

int StanceTree::RootOf(int index) const {
  while (nodes_[index].parent >= 0) index = nodes_[index].parent;
  return index;
}

StanceNode StanceTree::After(int from, const ContactAssignment& to, int node) const {
  const StanceNode& before = nodes_[from];
  const Change change = ChangeBetween(before.stance.assignment, to);
  StanceNode stance_node{.stance = {to, before.stance.idle},
                         .node = node,
                         .parent = from,
                         .slides = before.slides + static_cast<int>(!change.slid.empty())};
  if (change.placed.valid()) stance_node.stance.idle[change.placed] = {};
  return stance_node;
}

void StanceTree::ExtendReachable(StanceNode& stance_node) {
  stance_node.reachable = checker_.ExtendAround(
      stance_node.stance, stance_node.node, kPatience * (1 + stance_node.expansions),
      [&](int node) { return is_enough_(node, stance_node.stance.assignment); },
      stance_node.blocked);
}

const std::vector<Keyframe>* StanceTree::MoveBetween(StanceNode& stance_node, int from, int to) {
  const auto [found, is_new] = stance_node.moves.try_emplace({from, to});
  if (is_new && !stance_node.blocked.contains(std::minmax({from, to}))) {
    const Keyframe first =
        from == stance_node.node ? stance_node.at : checker_.FrameAt(stance_node.stance, from);
    if (auto move = FindMove(setup_, stance_node.stance.assignment, first,
                             checker_.FrameAt(stance_node.stance, to))) {
      found->second = *std::move(move);
    }
  }
  return found->second.empty() ? nullptr : &found->second;
}

std::optional<std::vector<Keyframe>> StanceTree::MoveFrom(StanceNode& stance_node, int node) {
  for (int detour = 0; stance_node.reachable.predecessor.contains(node); ++detour) {
    const std::vector<int> path = stance_node.reachable.PathTo(node);
    std::vector<Keyframe> keyframes = {stance_node.at};
    std::size_t at = 1;
    while (at < path.size()) {
      const std::vector<Keyframe>* move = MoveBetween(stance_node, path[at - 1], path[at]);
      if (move == nullptr) break;
      keyframes.insert(keyframes.end(), move->begin() + 1, move->end());
      ++at;
    }
    if (at == path.size()) return keyframes;
    stance_node.blocked.insert(std::minmax({path[at - 1], path[at]}));
    // The rolled fingertips are valid along this path only.
    if (detour == kMaxDetours || setup_.rolled_on != nullptr) break;
    ExtendReachable(stance_node);
  }
  ++counts_.no_move;
  return std::nullopt;
}

bool StanceTree::PlanPathFromParent(StanceNode& stance_node) {
  stance_node.at = checker_.FrameAt(stance_node.stance, stance_node.node);
  if (stance_node.parent < 0) return true;
  const Stance& before = nodes_[stance_node.parent].stance;
  auto edge = paths_.Find(before, stance_node.stance, stance_node.node,
                          {stance_node.rolled_before, stance_node.rolled});
  if (!edge) {
    const bool slides =
        !ChangeBetween(before.assignment, stance_node.stance.assignment).slid.empty();
    ++(slides ? counts_.no_slide : counts_.no_path);
    return false;
  }
  stance_node.edge = *std::move(edge);
  stance_node.at = stance_node.edge.back().path.back();
  return true;
}

void StanceTree::IdleAsBefore(StanceNode& stance_node) const {
  if (stance_node.parent < 0) return;
  const Stance& before = nodes_[stance_node.parent].stance;
  for (std::size_t finger = 0; finger < before.assignment.size(); ++finger) {
    if (before.assignment[finger] == kNone && stance_node.stance.assignment[finger] == kNone) {
      stance_node.stance.idle[finger] = before.idle[finger];
    }
  }
}

int StanceTree::WithIdleConfiguration(int index, FingerIndex finger,
                                      const JointConfiguration& configuration) {
  std::vector<int> chain;
  int last = index;
  while (last >= 0 && nodes_[last].stance.assignment[finger] == kNone) {
    chain.push_back(last);
    last = nodes_[last].parent;
  }
  if (chain.empty() || (last < 0 && !has_given_start_)) return -1;
  std::ranges::reverse(chain);
  for (const int i : chain) {
    StanceNode stance_node = nodes_[i];
    stance_node.parent = last;
    stance_node.edge.clear();
    stance_node.is_executed = false;
    stance_node.goal_path_failed = false;
    stance_node.farthest = std::numeric_limits<int>::max();
    stance_node.moves.clear();
    stance_node.blocked.clear();
    IdleAsBefore(stance_node);
    stance_node.stance.idle[finger] = configuration;
    const bool is_free = checker_.IsPassable(stance_node.stance, stance_node.node) &&
                         PlanPathFromParent(stance_node) &&
                         stance_node.stance.idle[finger] == configuration;
    if (!is_free) return -1;
    last = Add(std::move(stance_node));
  }
  return last;
}

int StanceTree::AfterIdlingAbove(int index) {
  const int parent = nodes_[index].parent;
  const Stance& before = nodes_[parent].stance;
  const FingerIndex placed =
      ChangeBetween(before.assignment, nodes_[index].stance.assignment).placed;
  if (!placed.valid()) return -1;
  Stance above = before;
  const int point = nodes_[index].stance.assignment[placed];
  if (!checker_.IdleAbove(above, placed, point, nodes_[index].node)) return -1;
  const int begin = WithIdleConfiguration(parent, placed, above.idle[placed]);
  if (begin < 0) return -1;
  StanceNode stance_node = nodes_[index];
  stance_node.parent = begin;
  IdleAsBefore(stance_node);
  if (!PlanPathFromParent(stance_node)) return -1;
  return Add(std::move(stance_node));
}

int StanceTree::LastExecuted(int index) const {
  while (index >= 0 && !nodes_[index].is_executed) index = nodes_[index].parent;
  return index;
}

void StanceTree::MarkExecuted(int index) {
  for (; index >= 0; index = nodes_[index].parent) nodes_[index].is_executed = true;
}

int StanceTree::PruneAfter(int index, int changes) {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = nodes_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  int changes_so_far = -1;
  for (const int i : chain) {
    changes_so_far =
        nodes_[i].parent < 0 ? 0 : changes_so_far + static_cast<int>(nodes_[i].edge.size());
    if (changes_so_far <= changes) continue;
    Prune(i);
    return i;
  }
  return -1;
}

void StanceTree::LimitBefore(int index, int step) {
  nodes_[index].farthest = std::min(nodes_[index].farthest, step);
  for (int i = index; i < size(); ++i) {
    const StanceNode& stance_node = nodes_[i];
    if (stance_node.parent == index && grid_.StepOf(stance_node.node) > step &&
        !stance_node.is_executed)
      Prune(i);
  }
}

void StanceTree::Prune(int index) {
  nodes_[index].is_pruned = true;
  // A node has a larger index than its parent.
  for (int i = index; i < size(); ++i) {
    StanceNode& stance_node = nodes_[i];
    stance_node.is_pruned =
        stance_node.is_pruned || (stance_node.parent >= 0 && nodes_[stance_node.parent].is_pruned);
  }
}

std::optional<Gait> StanceTree::PathTo(int index, int node) {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = nodes_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  Gait gait{nodes_[chain.front()].stance.assignment, nodes_[chain.front()].at, {}};
  const auto move_to = [&](StanceNode& stance_node, int to) {
    if (stance_node.node == to) return true;
    auto move = MoveFrom(stance_node, to);
    if (move) gait.segments.push_back({PlanSegment::Kind::kMove, {}, kNone, *std::move(move)});
    return move.has_value();
  };
  for (const int i : chain) {
    StanceNode& stance_node = nodes_[i];
    if (stance_node.parent >= 0 && !move_to(nodes_[stance_node.parent], stance_node.node)) {
      Prune(i);
      return std::nullopt;
    }
    gait.segments.insert(gait.segments.end(), stance_node.edge.begin(), stance_node.edge.end());
  }
  if (!move_to(nodes_[index], node)) return std::nullopt;
  return gait;
}

}  // namespace regrasp::gait
