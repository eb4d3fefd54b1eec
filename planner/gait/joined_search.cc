#include "planner/gait/joined_search.h"

#include <algorithm>

#include "planner/gait/finger_path.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

namespace {

/// Postures of a finger at one contact that are the same but for rounding, radians.
constexpr double kSamePosture = 1e-6;

/// Of a path of a free finger between two ways that meet: what is lost with it is much.
constexpr int kExtensionsToMeet = 1000;

}  // namespace

BidirectionalSearch::BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid,
                                         IdlePostures idle_postures, const GaitEnds& ends,
                                         criteria::GraspMemory& memory, RandomStream& random,
                                         SimulateExecution carry_out)
    : setup_(setup),
      grid_(grid),
      reversed_(grid.Reversed()),
      idle_postures_(std::move(idle_postures)),
      random_(random),
      checker_(setup, grid_, idle_postures_),
      forward_(setup, grid_, checker_, ends, memory, random) {
  if (ends.start.empty() || ends.goal.empty() || !forward_.GoalIsHeld()) {
    forward_.SimulateEdges(std::move(carry_out));
    return;
  }
  if (grid.steps() > 0) reversed_checker_.emplace(setup, reversed_, idle_postures_);
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
  const int rest = search.last_expanded();
  const ContactAssignment& holding = search.StanceOf(rest).holding;
  (is_forward ? from_start_ : from_goal_)[holding].push_back(rest);
  other.AddTarget(holding);
  const auto& others = is_forward ? from_goal_ : from_start_;
  const auto found = others.find(holding);
  if (found == others.end()) return std::nullopt;
  for (const int candidate : found->second) {
    auto gait = is_forward ? Join(rest, candidate) : Join(candidate, rest);
    if (gait) return gait;
  }
  return std::nullopt;
}

int BidirectionalSearch::CommonNode(int forward, int backward) {
  // Mostly it is one that they were carried to already.
  for (const bool further : {false, true}) {
    if (further) {
      forward_.CarryAround(forward);
      backward_->CarryAround(backward);
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
        MoveFreeFingers(forward_.StanceOf(forward).holding, EndOf(*gait), EndOf(*back), stuck);
    if (between) {
      if (between->size() > 1) {
        gait->segments.push_back({PlanSegment::Kind::kMove, {}, kNone, *std::move(between)});
      }
      AppendReversed(back->segments, *gait);
      return gait;
    }
    if (!stuck.valid()) return std::nullopt;
    // One of the ends may have it elsewhere all along.
    const Posture& there = EndOf(*gait).postures[stuck];
    const Posture& other = EndOf(*back).postures[stuck];
    if (const int later = backward_->WithIdlePosture(backward, stuck, there); later >= 0) {
      backward = later;
    } else if (const int sooner = forward_.WithIdlePosture(forward, stuck, other); sooner >= 0) {
      forward = sooner;
    } else {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Keyframe>> BidirectionalSearch::MoveFreeFingers(
    const ContactAssignment& holding, const Keyframe& from, const Keyframe& to,
    FingerIndex& stuck) {
  std::vector<int> order;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    const Posture& posture = from.postures[finger];
    if (holding[finger] == kNone) {
      if (posture != to.postures[finger]) order.push_back(finger);
    } else if ((posture - to.postures[finger]).cwiseAbs().maxCoeff() > kSamePosture) {
      return std::nullopt;
    }
  }
  std::vector<Keyframe> path;
  bool is_free = false;
  do {
    path = {from};
    is_free = std::ranges::all_of(order, [&](int number) {
      const FingerIndex finger{number};
      const auto way =
          FindFreePath(setup_.scene, finger, from.postures[finger], to.postures[finger],
                       AllBut(setup_.scene, finger, path.back()), random_, kExtensionsToMeet);
      if (!way) {
        stuck = finger;
        return false;
      }
      for (std::size_t i = 1; i < way->size(); ++i) {
        path.push_back(path.back());
        path.back().postures[finger] = (*way)[i];
      }
      return true;
    });
  } while (!is_free && std::ranges::next_permutation(order).found);
  if (!is_free) return std::nullopt;
  stuck = {};
  Touching touching;
  bool is_same = true;
  for (std::size_t finger = 0; finger < holding.size(); ++finger) {
    touching.push_back(holding[finger] == kNone ? TipContact::kFree : TipContact::kTouching);
    is_same = is_same && path.back().postures[finger] == to.postures[finger];
  }
  if (is_same && path.back().pose.isApprox(to.pose, 0)) return path;
  // The same but for rounding.
  if (!IsClear(setup_.scene, path.back(), to, touching)) return std::nullopt;
  path.push_back(to);
  return path;
}

namespace {

/// Of one rest that is expanded: ways that are worked out with it.
constexpr int kMostJoins = 6;

}  // namespace

TurnSearch::TurnSearch(const HandSetup& setup, const PoseTrack& track, IdlePostures onwards,
                       IdlePostures backwards, criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      grid_(track, setup.scene.hand().up, PoseGrid::End::kOrientation),
      back_grid_(track.Backwards(), setup.scene.hand().up, PoseGrid::End::kOrientation),
      idle_postures_(std::move(onwards)),
      back_idle_postures_(std::move(backwards)),
      memory_(memory),
      random_(random),
      checker_(setup, grid_, idle_postures_),
      back_checker_(setup, back_grid_, back_idle_postures_),
      onwards_(setup, grid_, checker_, {}, memory, random) {}

GaitCounts TurnSearch::counts() const {
  GaitCounts counts = onwards_.counts();
  for (const auto& [rest, root] : roots_) {
    counts.farthest = std::max(counts.farthest, std::min(counts.steps, root.farthest()));
    if (root.search) counts.Add(root.search->counts());
  }
  return counts;
}

std::optional<Gait> TurnSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  while (counts().expanded < most_expanded && !IsExhausted() && !deadline.IsOver()) {
    const std::int64_t before = onwards_.counts().expanded;
    if (auto gait = onwards_.Run(before + 1, deadline)) return gait;
    if (onwards_.counts().expanded > before) {
      if (auto gait = TakeDown(onwards_.RootOf(onwards_.last_expanded()), true)) return gait;
    }
    const int root = BestRoot();
    if (root < 0) continue;
    GaitSearch& backwards = BackwardsFrom(root);
    const std::int64_t had = backwards.counts().expanded;
    if (auto gait = backwards.Run(had + 1, deadline)) {
      Gait turn{AssignmentAtEnd(*gait), EndOf(*gait), {}};
      AppendReversed(gait->segments, turn);
      return turn;
    }
    if (backwards.counts().expanded > had) {
      if (auto gait = TakeDown(root, false)) return gait;
    }
  }
  return std::nullopt;
}

int TurnSearch::BestRoot() const {
  int best = -1;
  int farthest = -1;
  for (const auto& [rest, root] : roots_) {
    if (root.search && root.search->IsExhausted()) continue;
    if (root.farthest() <= farthest) continue;
    farthest = root.farthest();
    best = rest;
  }
  return best;
}

GaitSearch& TurnSearch::BackwardsFrom(int root) {
  std::optional<GaitSearch>& search = roots_[root].search;
  if (!search) {
    search.emplace(setup_, back_grid_, back_checker_, GaitEnds{}, memory_, random_);
    search->StartFrom(onwards_.StanceOf(root));
  }
  return *search;
}

std::optional<Gait> TurnSearch::TakeDown(int root, bool is_onwards) {
  Root& from = roots_[root];
  GaitSearch& search = is_onwards ? onwards_ : *from.search;
  Reached& reached = is_onwards ? from.onwards : from.backwards;
  const Reached& other = is_onwards ? from.backwards : from.onwards;
  const int rest = search.last_expanded();
  int joins = 0;
  // Ways that are worked out may lead it to other ones.
  const std::map<int, int> nodes = search.NodesOf(rest);
  for (const auto& [node, before] : nodes) {
    const int step = grid_.StepOf(node);
    const int tilt = grid_.TiltOf(node);
    reached.farthest = std::max(reached.farthest, step);
    reached.places[{step, tilt}].emplace_back(rest, node);
    const auto found = other.places.find({grid_.steps() - step, tilt});
    if (found == other.places.end()) continue;
    for (const auto& place : found->second) {
      const std::pair here(rest, node);
      const std::pair rests =
          is_onwards ? std::pair(rest, place.first) : std::pair(place.first, rest);
      if (onwards_.IsCutOff(rests.first) || from.search->IsCutOff(rests.second)) continue;
      if (joins == kMostJoins || !simulation_.insert(rests).second) continue;
      ++joins;
      auto gait = is_onwards ? Join(root, here, place) : Join(root, place, here);
      if (gait) return gait;
    }
  }
  return std::nullopt;
}

std::optional<Gait> TurnSearch::Join(int root, std::pair<int, int> onwards,
                                     std::pair<int, int> backwards) {
  const std::optional<Gait> on = onwards_.PathTo(onwards.first, onwards.second);
  if (!on) return std::nullopt;
  const std::optional<Gait> back = roots_[root].search->PathTo(backwards.first, backwards.second);
  if (!back) return std::nullopt;
  Gait turn{AssignmentAtEnd(*back), EndOf(*back), {}};
  AppendReversed(back->segments, turn);
  turn.segments.insert(turn.segments.end(), on->segments.begin(), on->segments.end());
  return turn;
}

}  // namespace regrasp::gait
