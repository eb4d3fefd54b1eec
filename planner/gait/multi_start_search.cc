#include "planner/gait/multi_start_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "planner/gait/initial_pose.h"
#include "planner/gait/plan_of_gait.h"

namespace regrasp::gait {

namespace {

/// Expansions of one search before the next search continues.
constexpr std::int64_t kExpandedPerRun = 6;
/// Total expansions per initial pose before another one is added: constant, and per track step if
/// that is larger. Deep searches solve more full rotations than many shallow ones: 19 instead of 16
/// of 20 within 8 s with an Allegro hand.
constexpr std::int64_t kExpandedForNext = 20;
constexpr double kExpandedForStep = 0.75;
/// Number of times that initial poses are drawn.
constexpr int kPoseDrawings = 4;

}  // namespace

MultiStartSearch::MultiStartSearch(const GaitRequest& request, std::vector<SearchTerms> terms,
                                   GaitEnds ends)
    : request_(request),
      terms_(std::move(terms)),
      ends_(std::move(ends)),
      random_(request.seed, RandomUse::kHomes),
      task_(request.scale * request.solid->mass_properties().centroid, request.turn, request.goal,
            request.turn_tolerance) {}

std::optional<Gait> MultiStartSearch::Search() {
  while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
    Start* start = Next();
    if (start == nullptr) return std::nullopt;
    const std::int64_t before = start->search->counts().expanded;
    const std::optional<Gait> gait = start->search->Run(
        before + std::min(kExpandedPerRun, request_.most_expanded - expanded_), request_.deadline);
    if (gait) return MergeMoves(start->terms.setup, *gait);
    expanded_ += start->search->counts().expanded - before;
    if (const double fraction = start->search->counts().fraction(); fraction > reached_) {
      reached_ = fraction;
      expanded_at_reached_ = expanded_;
    }
    if (expanded_ - expanded_at_reached_ >= request_.patience) return std::nullopt;
    request_.progress("searching a gait: " + std::to_string(expanded_) + " stances expanded from " +
                      std::to_string(starts_.size()) + " initial poses");
  }
  return std::nullopt;
}

std::vector<GaitCounts> MultiStartSearch::counts() const {
  std::vector<GaitCounts> counts;
  for (const auto& start : starts_) counts.push_back(start->search->counts());
  return counts;
}

std::int64_t MultiStartSearch::BudgetForNextStart() const {
  if (starts_.empty()) return 0;
  const int steps = starts_.front()->search->counts().steps;
  return static_cast<std::int64_t>(starts_.size()) *
         std::max<std::int64_t>(kExpandedForNext, std::llround(kExpandedForStep * steps));
}

MultiStartSearch::Start* MultiStartSearch::Next() {
  if (expanded_ >= BudgetForNextStart() && OpenNextStart()) return starts_.back().get();
  Start* next = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& start : starts_) {
    if (start->search->IsExhausted()) continue;
    const GaitCounts counts = start->search->counts();
    const double farther = 1.0 + counts.farthest;
    const double weight = static_cast<double>(counts.expanded) / (farther * farther);
    if (weight >= least) continue;
    least = weight;
    next = start.get();
  }
  return next == nullptr && OpenNextStart() ? starts_.back().get() : next;
}

bool MultiStartSearch::OpenNextStart() {
  while (true) {
    if (tracks_.empty()) {
      if (!DrawTracks()) return false;
      continue;
    }
    const PoseTrack track = tracks_.back();
    tracks_.pop_back();
    auto start = std::make_unique<Start>(
        Start{terms_[opened_++ % terms_.size()],
              RandomStream(request_.seed, RandomUse::kGaits, starts_.size())});
    start->search = SearchAlong(track, start->terms, start->random);
    if (!start->search || !start->search->GoalIsHeld()) continue;
    starts_.push_back(std::move(start));
    return true;
  }
}

std::unique_ptr<StartSearch> MultiStartSearch::SearchAlong(const PoseTrack& track,
                                                           const SearchTerms& terms,
                                                           RandomStream& random) {
  const HandSetup& setup = terms.setup;
  std::optional<IdleConfigurations> idle_configurations =
      FindIdleConfigurations(setup, track, random_);
  // Idle fingers of a given start state may have to move before the object reaches them.
  if (!idle_configurations && !request_.start_joints.empty()) {
    idle_configurations = FindIdleConfigurations(setup, track.InSteps(0), random_);
  }
  if (!idle_configurations) return nullptr;
  const bool is_turn = !request_.goal && track.steps() > 0;
  // Contacts roll, and edges are simulated, in the direction of time only.
  const bool is_one_directional = setup.rolled_on != nullptr || terms.simulate;
  const bool may_begin_anywhere = is_turn && !request_.turn_tolerance && !request_.start_pose &&
                                  ends_.start.empty() && ends_.goal.empty() && !is_one_directional;
  if (may_begin_anywhere) {
    if (auto backward = FindIdleConfigurations(setup, track.Backwards(), random_)) {
      return std::make_unique<TurnSearch>(setup, track, *std::move(idle_configurations),
                                          *std::move(backward), terms.memory, random);
    }
  }
  const Eigen::Vector3d& up = setup.scene.hand().up;
  const auto goal = task_.GoalFrom(track.PoseAt(0));
  const PoseGrid grid =
      goal && !goal->HasDefaultTolerance()
          ? PoseGrid(track, up, *goal)
          : PoseGrid(track, up, is_turn ? PoseGrid::End::kOrientation : PoseGrid::End::kPose);
  return std::make_unique<BidirectionalSearch>(setup, grid, *std::move(idle_configurations), ends_,
                                               terms.memory, random, terms.simulate);
}

bool MultiStartSearch::DrawTracks() {
  if (++drawings_ > (request_.start_pose ? 1 : kPoseDrawings)) return false;
  if (request_.start_pose) {
    for (const PoseTrack& track : task_.Tracks(*request_.start_pose)) {
      tracks_.insert(tracks_.end(), terms_.size(), track);
      drawn_tracks_.push_back(track);
    }
  } else {
    const SearchTerms& first = terms_.front();
    for (const auto& pose : FindInitialPoses(first.setup, task_, ends_, first.memory, random_)) {
      tracks_.push_back(task_.From(pose));
      drawn_tracks_.push_back(tracks_.back());
    }
  }
  std::ranges::reverse(tracks_);
  return true;
}

}  // namespace regrasp::gait
