#include "planner/gait/turn_search.h"

#include <algorithm>

namespace regrasp::gait {
namespace {

/// Of one rest that is expanded: ways that are worked out with it.
constexpr int kMostJoins = 6;

}  // namespace

TurnSearch::TurnSearch(const HandSetup& setup, const PoseTrack& track, Parking onwards,
                       Parking backwards, criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      grid_(track, setup.scene.hand().up, PoseGrid::End::kOrientation),
      back_grid_(track.Backwards(), setup.scene.hand().up, PoseGrid::End::kOrientation),
      parking_(std::move(onwards)),
      back_parking_(std::move(backwards)),
      memory_(memory),
      random_(random),
      carrier_(setup, grid_, parking_),
      back_carrier_(setup, back_grid_, back_parking_),
      onwards_(setup, grid_, carrier_, {}, memory, random) {}

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
      Gait turn{HoldingAtEnd(*gait), EndOf(*gait), {}};
      AppendReversed(gait->stretches, turn);
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
    search.emplace(setup_, back_grid_, back_carrier_, GaitEnds{}, memory_, random_);
    search->BeginWith(onwards_.HoldOf(root));
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
      if (joins == kMostJoins || !tried_.insert(rests).second) continue;
      ++joins;
      auto gait = is_onwards ? Join(root, here, place) : Join(root, place, here);
      if (gait) return gait;
    }
  }
  return std::nullopt;
}

std::optional<Gait> TurnSearch::Join(int root, std::pair<int, int> onwards,
                                     std::pair<int, int> backwards) {
  const std::optional<Gait> on = onwards_.WayTo(onwards.first, onwards.second);
  if (!on) return std::nullopt;
  const std::optional<Gait> back = roots_[root].search->WayTo(backwards.first, backwards.second);
  if (!back) return std::nullopt;
  Gait turn{HoldingAtEnd(*back), EndOf(*back), {}};
  AppendReversed(back->stretches, turn);
  turn.stretches.insert(turn.stretches.end(), on->stretches.begin(), on->stretches.end());
  return turn;
}

}  // namespace regrasp::gait
