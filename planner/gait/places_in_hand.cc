#include "planner/gait/places_in_hand.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "planner/gait/bidirectional_search.h"
#include "planner/gait/fewer_moves.h"
#include "planner/gait/home.h"
#include "planner/gait/turn_search.h"

namespace regrasp::gait {
namespace {

/// Grasps expanded from one place in the hand before others have their turn.
constexpr int kExpandedAtOnce = 6;
/// From all places together, by their number, before there is another one: so many, and so many
/// for each step of the way where that is more. Of whole turns more come to their end so than with
/// many places from which little grows: in an Allegro hand 19 of 20 instead of 16 within 8 s.
constexpr std::int64_t kExpandedForNext = 20;
constexpr double kExpandedForStep = 0.75;
/// Times that places are looked for.
constexpr int kPoseDrawings = 4;

}  // namespace

PlacesInHand::PlacesInHand(const GaitRequest& request, std::vector<SearchTerms> terms,
                           GaitEnds ends)
    : request_(request),
      terms_(std::move(terms)),
      ends_(std::move(ends)),
      random_(request.seed, RandomUse::kHomes),
      journey_(request.scale * request.solid->mass_properties().centroid, request.turn,
               request.goal_pose) {}

std::optional<Gait> PlacesInHand::Search() {
  while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
    Place* place = Next();
    if (place == nullptr) return std::nullopt;
    const std::int64_t before = place->search->counts().expanded;
    const std::optional<Gait> gait =
        place->search->Run(before + kExpandedAtOnce, request_.deadline);
    if (gait) return WithFewerMoves(place->terms.setup, *gait);
    expanded_ += place->search->counts().expanded - before;
    request_.progress("searching a gait, " + std::to_string(expanded_) + " grasps from " +
                      std::to_string(places_.size()) + " places in the hand");
  }
  return std::nullopt;
}

std::vector<GaitCounts> PlacesInHand::counts() const {
  std::vector<GaitCounts> counts;
  for (const auto& place : places_) counts.push_back(place->search->counts());
  return counts;
}

std::int64_t PlacesInHand::EnoughForNext() const {
  if (places_.empty()) return 0;
  const int steps = places_.front()->search->counts().steps;
  return static_cast<std::int64_t>(places_.size()) *
         std::max<std::int64_t>(kExpandedForNext, std::llround(kExpandedForStep * steps));
}

PlacesInHand::Place* PlacesInHand::Next() {
  if (expanded_ >= EnoughForNext() && Open()) return places_.back().get();
  Place* next = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : places_) {
    if (place->search->IsExhausted()) continue;
    const GaitCounts counts = place->search->counts();
    const double farther = 1.0 + counts.farthest;
    const double had = static_cast<double>(counts.expanded) / (farther * farther);
    if (had >= least) continue;
    least = had;
    next = place.get();
  }
  return next == nullptr && Open() ? places_.back().get() : next;
}

bool PlacesInHand::Open() {
  while (true) {
    if (homes_.empty()) {
      if (!DrawHomes()) return false;
      continue;
    }
    const PoseTrack track = journey_.From(homes_.back());
    homes_.pop_back();
    auto place = std::make_unique<Place>(
        Place{terms_[opened_++ % terms_.size()],
              RandomStream(request_.seed, RandomUse::kGaits, places_.size())});
    place->search = SearchAlong(track, place->terms, place->random);
    if (!place->search || !place->search->GoalIsHeld()) continue;
    places_.push_back(std::move(place));
    return true;
  }
}

std::unique_ptr<PlaceSearch> PlacesInHand::SearchAlong(const PoseTrack& track,
                                                       const SearchTerms& terms,
                                                       RandomStream& random) {
  const HandSetup& setup = terms.setup;
  std::optional<Parking> parking = FindParking(setup, track, random_);
  if (!parking) return nullptr;
  const bool is_turn = !request_.goal_pose && track.steps() > 0;
  // Contacts roll one way, and what is tried is carried out one way.
  const bool goes_one_way = setup.rolled_on != nullptr || terms.carry_out;
  const bool may_begin_anywhere =
      is_turn && !request_.start_pose && ends_.start.empty() && ends_.goal.empty() && !goes_one_way;
  if (may_begin_anywhere) {
    if (auto backwards = FindParking(setup, track.Backwards(), random_)) {
      return std::make_unique<TurnSearch>(setup, track, *std::move(parking), *std::move(backwards),
                                          terms.memory, random);
    }
  }
  const PoseGrid grid(track, setup.scene.hand().up,
                      is_turn ? PoseGrid::End::kOrientation : PoseGrid::End::kPose);
  return std::make_unique<BidirectionalSearch>(setup, grid, *std::move(parking), ends_,
                                               terms.memory, random, terms.carry_out);
}

bool PlacesInHand::DrawHomes() {
  if (++drawings_ > (request_.start_pose ? 1 : kPoseDrawings)) return false;
  if (request_.start_pose) {
    homes_.assign(terms_.size(), *request_.start_pose);
    return true;
  }
  const SearchTerms& first = terms_.front();
  homes_ = FindHomes(first.setup, journey_, ends_, first.memory, random_);
  std::ranges::reverse(homes_);
  return true;
}

}  // namespace regrasp::gait
