#include "planner/gait/bidirectional_search.h"

#include <algorithm>

#include "planner/gait/certified_path.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/move_path.h"

namespace regrasp::gait {
namespace {

/// Postures of a finger at one contact that are the same but for rounding, radians.
constexpr double kSamePosture = 1e-6;

/// Of a path of a free finger between two ways that meet: what is lost with it is much.
constexpr int kExtensionsToMeet = 1000;

}  // namespace

BidirectionalSearch::BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid,
                                         Parking parking, const GaitEnds& ends,
                                         criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      grid_(grid),
      reversed_(grid.Reversed()),
      parking_(std::move(parking)),
      random_(random),
      carrier_(setup, grid_, parking_),
      forward_(setup, grid_, carrier_, ends, memory, random) {
  if (ends.start.empty() || ends.goal.empty() || !forward_.GoalIsHeld()) return;
  if (grid.steps() > 0) reversed_carrier_.emplace(setup, reversed_, parking_);
  backward_.emplace(setup, reversed_, reversed_carrier_ ? *reversed_carrier_ : carrier_,
                    GaitEnds{ends.goal, ends.start}, memory, random);
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
  const Holding& holding = search.HoldOf(rest).holding;
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

std::optional<Gait> BidirectionalSearch::Join(int forward, int backward) {
  const std::map<int, int>& nodes = forward_.NodesOf(forward);
  const std::map<int, int>& others = backward_->NodesOf(backward);
  const auto common = std::ranges::find_if(
      nodes, [&](const auto& node) { return others.contains(grid_.Mirrored(node.first)); });
  if (common == nodes.end()) return std::nullopt;
  const int node = common->first;
  std::optional<Gait> gait = forward_.WayTo(forward, node);
  if (!gait) return std::nullopt;
  const std::optional<Gait> back = backward_->WayTo(backward, grid_.Mirrored(node));
  if (!back) return std::nullopt;
  auto between = MoveFreeFingers(forward_.HoldOf(forward).holding, EndOf(*gait), EndOf(*back));
  if (!between) return std::nullopt;
  if (between->size() > 1) {
    gait->stretches.push_back({Stretch::Kind::kMove, {}, kNone, *std::move(between)});
  }
  AppendReversed(back->stretches, *gait);
  return gait;
}

std::optional<std::vector<Keyframe>> BidirectionalSearch::MoveFreeFingers(const Holding& holding,
                                                                          const Keyframe& from,
                                                                          const Keyframe& to) {
  std::vector<Keyframe> path = {from};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    const Posture& posture = from.postures[finger];
    if (holding[finger] != kNone) {
      if ((posture - to.postures[finger]).cwiseAbs().maxCoeff() > kSamePosture) return std::nullopt;
      continue;
    }
    if (posture == to.postures[finger]) continue;
    const auto way =
        FindFreePath(setup_.scene, finger, posture, to.postures[finger],
                     AllBut(setup_.scene, finger, path.back()), random_, kExtensionsToMeet);
    if (!way) return std::nullopt;
    for (std::size_t i = 1; i < way->size(); ++i) {
      path.push_back(path.back());
      path.back().postures[finger] = (*way)[i];
    }
  }
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

}  // namespace regrasp::gait
