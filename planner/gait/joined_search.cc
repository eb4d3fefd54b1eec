#include "planner/gait/joined_search.h"

#include <algorithm>

#include "planner/gait/finger_path.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

namespace {

/// Joint configurations of a finger at one contact that differ only by rounding, radians.
constexpr double kSameConfiguration = 1e-6;

/// Maximum number of RRT extensions for a path that connects both trees.
/// It is large because a failure discards both paths.
constexpr int kExtensionsToMeet = 1000;

/// Maximum number of planned connections per expanded stance.
constexpr int kMaxJoins = 6;

}  // namespace

BidirectionalSearch::BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid,
                                         IdleConfigurations idle_configurations,
                                         const GaitEnds& ends, criteria::GraspMemory& memory,
                                         RandomStream& random, SimulateExecution simulate)
    : setup_(setup),
      grid_(grid),
      reversed_(grid.Reversed()),
      idle_configurations_(std::move(idle_configurations)),
      random_(random),
      checker_(setup, grid_, idle_configurations_),
      forward_(setup, grid_, checker_, ends, memory, random) {
  if (ends.start.empty() || ends.goal.empty() || !forward_.GoalIsHeld()) {
    forward_.SimulateEdges(std::move(simulate));
    return;
  }
  if (grid.steps() > 0) reversed_checker_.emplace(setup, reversed_, idle_configurations_);
  backward_.emplace(setup, reversed_, reversed_checker_ ? *reversed_checker_ : checker_,
                    GaitEnds{ends.goal, ends.start, ends.goal_fingers, ends.start_fingers}, memory,
                    random);
}

bool BidirectionalSearch::IsExhausted() const {
  return forward_.IsExhausted() || (backward_ && backward_->IsExhausted());
}

GaitCounts BidirectionalSearch::counts() const {
  GaitCounts counts = forward_.counts();
  if (!backward_) return counts;
  counts.Add(backward_->counts());
  return counts;
}

std::optional<Gait> BidirectionalSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  if (!backward_) return forward_.Run(most_expanded, deadline);
  return RunFromBothEnds(most_expanded, deadline);
}

std::optional<Gait> BidirectionalSearch::RunFromBothEnds(std::int64_t most_expanded,
                                                         const Deadline& deadline) {
  while (counts().expanded < most_expanded && !IsExhausted() && !deadline.IsOver()) {
    const bool is_forward = forward_.counts().expanded <= backward_->counts().expanded;
    GaitSearch& search = is_forward ? forward_ : *backward_;
    const std::int64_t before = search.counts().expanded;
    std::optional<Gait> gait = search.Run(before + 1, deadline);
    if (gait && is_forward) return gait;
    if (search.counts().expanded == before) continue;
    if (auto joined = Meet(is_forward)) return joined;
  }
  return std::nullopt;
}

std::optional<Gait> BidirectionalSearch::Meet(bool is_forward) {
  GaitSearch& search = is_forward ? forward_ : *backward_;
  GaitSearch& other = is_forward ? *backward_ : forward_;
  const int index = search.last_expanded();
  const ContactAssignment& assignment = search.StanceOf(index).assignment;
  (is_forward ? from_start_ : from_goal_)[assignment].push_back(index);
  other.AddTarget(assignment);
  const auto& others = is_forward ? from_goal_ : from_start_;
  const auto found = others.find(assignment);
  if (found == others.end()) return std::nullopt;
  for (const int candidate : found->second) {
    auto gait = is_forward ? Join(index, candidate) : Join(candidate, index);
    if (gait) return gait;
  }
  return std::nullopt;
}

int BidirectionalSearch::CommonNode(int forward, int backward) {
  // Nodes reached so far usually suffice.
  for (const bool further : {false, true}) {
    if (further) {
      forward_.ExtendReachable(forward);
      backward_->ExtendReachable(backward);
    }
    const std::map<int, int>& others = backward_->NodesOf(backward);
    for (const auto& [node, before] : forward_.NodesOf(forward)) {
      if (others.contains(grid_.Mirrored(node))) return node;
    }
  }
  return PoseGrid::kNoNode;
}

std::optional<Gait> BidirectionalSearch::Join(int forward, int backward) {
  const int node = CommonNode(forward, backward);
  if (node == PoseGrid::kNoNode) return std::nullopt;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    std::optional<Gait> gait = forward_.PathTo(forward, node);
    if (!gait) return std::nullopt;
    const std::optional<Gait> back = backward_->PathTo(backward, grid_.Mirrored(node));
    if (!back) return std::nullopt;
    FingerIndex stuck;
    auto between =
        MoveIdleFingers(forward_.StanceOf(forward).assignment, EndOf(*gait), EndOf(*back), stuck);
    if (between) {
      if (between->size() > 1) {
        gait->segments.push_back({PlanSegment::Kind::kMove, {}, kNone, *std::move(between)});
      }
      AppendReversed(back->segments, *gait);
      return gait;
    }
    if (!stuck.valid()) return std::nullopt;
    // Give the finger the same idle configuration in both trees.
    const JointConfiguration& forward_configuration = EndOf(*gait).configurations[stuck];
    const JointConfiguration& backward_configuration = EndOf(*back).configurations[stuck];
    if (const int backward_copy =
            backward_->WithIdleConfiguration(backward, stuck, forward_configuration);
        backward_copy >= 0) {
      backward = backward_copy;
    } else if (const int forward_copy =
                   forward_.WithIdleConfiguration(forward, stuck, backward_configuration);
               forward_copy >= 0) {
      forward = forward_copy;
    } else {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Keyframe>> BidirectionalSearch::MoveIdleFingers(
    const ContactAssignment& assignment, const Keyframe& from, const Keyframe& to,
    FingerIndex& stuck) {
  std::vector<int> order;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    const JointConfiguration& configuration = from.configurations[finger];
    if (assignment[finger] == kNone) {
      if (configuration != to.configurations[finger]) order.push_back(finger);
    } else if ((configuration - to.configurations[finger]).cwiseAbs().maxCoeff() >
               kSameConfiguration) {
      return std::nullopt;
    }
  }
  std::vector<Keyframe> path;
  bool is_free = false;
  do {
    path = {from};
    is_free = std::ranges::all_of(order, [&](int number) {
      const FingerIndex finger{number};
      const auto free_path =
          FindFreePath(setup_.scene, finger, from.configurations[finger], to.configurations[finger],
                       AllExcept(setup_.scene, finger, path.back()), random_, kExtensionsToMeet);
      if (!free_path) {
        stuck = finger;
        return false;
      }
      for (std::size_t i = 1; i < free_path->size(); ++i) {
        path.push_back(path.back());
        path.back().configurations[finger] = (*free_path)[i];
      }
      return true;
    });
  } while (!is_free && std::ranges::next_permutation(order).found);
  if (!is_free) return std::nullopt;
  stuck = {};
  Touching touching;
  bool is_same = true;
  for (std::size_t finger = 0; finger < assignment.size(); ++finger) {
    touching.push_back(assignment[finger] == kNone ? TipContact::kFree : TipContact::kTouching);
    is_same = is_same && path.back().configurations[finger] == to.configurations[finger];
  }
  if (is_same && path.back().pose.isApprox(to.pose, 0)) return path;
  // Remove the difference due to rounding.
  if (!IsClear(setup_.scene, path.back(), to, touching)) return std::nullopt;
  path.push_back(to);
  return path;
}

TurnSearch::TurnSearch(const HandSetup& setup, const PoseTrack& track, IdleConfigurations forward,
                       IdleConfigurations backward, criteria::GraspMemory& memory,
                       RandomStream& random)
    : setup_(setup),
      grid_(track, setup.scene.hand().up, PoseGrid::End::kOrientation),
      back_grid_(track.Backwards(), setup.scene.hand().up, PoseGrid::End::kOrientation),
      idle_configurations_(std::move(forward)),
      back_idle_configurations_(std::move(backward)),
      memory_(memory),
      random_(random),
      checker_(setup, grid_, idle_configurations_),
      back_checker_(setup, back_grid_, back_idle_configurations_),
      forward_(setup, grid_, checker_, {}, memory, random) {}

GaitCounts TurnSearch::counts() const {
  GaitCounts counts = forward_.counts();
  for (const auto& [index, root] : roots_) {
    counts.farthest = std::max(counts.farthest, std::min(counts.steps, root.farthest()));
    if (root.search) counts.Add(root.search->counts());
  }
  return counts;
}

std::optional<Gait> TurnSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  while (counts().expanded < most_expanded && !IsExhausted() && !deadline.IsOver()) {
    const std::int64_t before = forward_.counts().expanded;
    if (auto gait = forward_.Run(before + 1, deadline)) return gait;
    if (forward_.counts().expanded > before) {
      if (auto gait = RecordReached(forward_.RootOf(forward_.last_expanded()), true)) return gait;
    }
    const int root = BestRoot();
    if (root < 0) continue;
    GaitSearch& backward = BackwardFrom(root);
    const std::int64_t expanded_before = backward.counts().expanded;
    if (auto gait = backward.Run(expanded_before + 1, deadline)) {
      Gait turn{AssignmentAtEnd(*gait), EndOf(*gait), {}};
      AppendReversed(gait->segments, turn);
      return turn;
    }
    if (backward.counts().expanded > expanded_before) {
      if (auto gait = RecordReached(root, false)) return gait;
    }
  }
  return std::nullopt;
}

int TurnSearch::BestRoot() const {
  int best = -1;
  int farthest = -1;
  for (const auto& [index, root] : roots_) {
    if (root.search && root.search->IsExhausted()) continue;
    if (root.farthest() <= farthest) continue;
    farthest = root.farthest();
    best = index;
  }
  return best;
}

GaitSearch& TurnSearch::BackwardFrom(int root) {
  std::optional<GaitSearch>& search = roots_[root].search;
  if (!search) {
    search.emplace(setup_, back_grid_, back_checker_, GaitEnds{}, memory_, random_);
    search->StartFrom(forward_.StanceOf(root));
  }
  return *search;
}

std::optional<Gait> TurnSearch::RecordReached(int root, bool is_forward) {
  Root& from = roots_[root];
  GaitSearch& search = is_forward ? forward_ : *from.search;
  Reached& reached = is_forward ? from.forward : from.backward;
  const Reached& other = is_forward ? from.backward : from.forward;
  const int index = search.last_expanded();
  int joins = 0;
  // A copy: Join may plan detours, which change the nodes.
  const std::map<int, int> nodes = search.NodesOf(index);
  for (const auto& [node, before] : nodes) {
    const int step = grid_.StepOf(node);
    const int tilt = grid_.TiltOf(node);
    reached.farthest = std::max(reached.farthest, step);
    reached.nodes_at[{step, tilt}].emplace_back(index, node);
    const auto found = other.nodes_at.find({grid_.steps() - step, tilt});
    if (found == other.nodes_at.end()) continue;
    for (const auto& other_node : found->second) {
      const std::pair here(index, node);
      const std::pair pair =
          is_forward ? std::pair(index, other_node.first) : std::pair(other_node.first, index);
      if (forward_.IsPruned(pair.first) || from.search->IsPruned(pair.second)) continue;
      if (joins == kMaxJoins || !joined_.insert(pair).second) continue;
      ++joins;
      auto gait = is_forward ? Join(root, here, other_node) : Join(root, other_node, here);
      if (gait) return gait;
    }
  }
  return std::nullopt;
}

std::optional<Gait> TurnSearch::Join(int root, std::pair<int, int> forward,
                                     std::pair<int, int> backward) {
  const std::optional<Gait> on = forward_.PathTo(forward.first, forward.second);
  if (!on) return std::nullopt;
  const std::optional<Gait> back = roots_[root].search->PathTo(backward.first, backward.second);
  if (!back) return std::nullopt;
  Gait turn{AssignmentAtEnd(*back), EndOf(*back), {}};
  AppendReversed(back->segments, turn);
  turn.segments.insert(turn.segments.end(), on->segments.begin(), on->segments.end());
  return turn;
}

}  // namespace regrasp::gait
