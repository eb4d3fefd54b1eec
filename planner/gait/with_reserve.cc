#include "planner/gait/with_reserve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "planner/gait/plan_of_gait.h"

namespace regrasp::gait {
namespace {

constexpr std::array kFollowed = {Spare{0.05, 1.5e-3, 0.2}, Spare{0.02, 1.5e-3, 0.1}};
/// Grasps that are expanded for each of them where there is a gait without, for each quarter turn,
/// and share of the time that is left.
constexpr std::int64_t kExpandedToFollow = 40;
constexpr double kTimeToFollow = 0.4;
/// With reserve a gait may have so many times as many stretches as without, and so many more.
constexpr std::size_t kTimesAsLong = 3;
constexpr std::size_t kLonger = 12;

/// Of what is tried on the way, place by place: two of three times contacts are not followed, which
/// is found sooner; where they are, more is carried out.
constexpr Spare kNotFollowed = {0.05, 0.5e-3};
constexpr std::array kTried = {kNotFollowed, kNotFollowed, kFollowed.front()};
/// Grasps that are expanded for each quarter turn the first time, twice as many the next time.
constexpr std::int64_t kExpandedInRound = 300;
/// Times that all is looked for; more where a time limit ends it.
constexpr int kRounds = 2;
constexpr int kMostRounds = 6;
constexpr int kStreamShift = 32;  ///< of seeds
/// Whole gaits are tried first, when they are found: of short turns those whose contacts are not
/// followed, which may begin at any angle; of others those where they are, which ring hands mostly
/// carry out. With no more grasps, for each quarter turn, and time each than this.
constexpr std::array kTriedWhole = {kNotFollowed, Spare{0.02, 0}};
constexpr double kShortTurn = 1.75;  ///< radians
constexpr std::int64_t kExpandedWhole = 40;
/// So often from other places in the hand, as long as there are any: mostly a single move, which is
/// found at once and either carried out or not.
constexpr int kTimesWhole = 4;
constexpr double kTimeForWhole = 0.15;
/// Share of all the time before a gait without reserve is looked for.
constexpr double kTimeBeforeWithout = 0.85;

void Bound(GaitRequest& asked, std::int64_t expanded, double share) {
  const double quarters = std::max(1.0, std::abs(asked.turn.angle) / (std::numbers::pi / 2));
  asked.most_expanded = std::min<std::int64_t>(
      asked.most_expanded, std::llround(quarters * static_cast<double>(expanded)));
  asked.deadline = asked.deadline.After(share);
}

std::optional<planning::CarriedOut> Try(const Gait& gait, const GaitRequest& request,
                                        const std::vector<grasp::Contact>& contacts,
                                        const Deadline& deadline) {
  request.progress("trying a plan on the hand's own motors");
  return request.carry_out(PlanOf(gait, request, contacts), deadline);
}

/// One look for a gait.
struct Look {
  std::span<const Spare> spares;
  std::uint64_t stream;  ///< of random numbers
  std::int64_t expanded;
  double time;
  bool is_whole;          ///< tried when it is found, and not on the way
  bool is_again = false;  ///< left out where the look before it found nothing
};

/// In their order.
std::vector<Look> LooksFor(const GaitRequest& request) {
  const bool is_short_turn = !request.goal_pose && std::abs(request.turn.angle) <= kShortTurn;
  const std::span<const Spare> whole =
      is_short_turn ? std::span<const Spare>(kTriedWhole) : std::span(&kFollowed.front(), 1);
  std::vector<Look> looks;
  const int rounds = request.deadline.left() ? kMostRounds : kRounds;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t stream = static_cast<std::uint64_t>(round) * kTimesWhole;
    for (const Spare& spare : whole) {
      for (int again = 0; again < kTimesWhole; ++again) {
        looks.push_back(
            {{&spare, 1}, stream + again, kExpandedWhole, kTimeForWhole, true, again > 0});
      }
    }
    looks.push_back({kTried, stream, kExpandedInRound << round, 1, false});
  }
  return looks;
}

TriedGait FindAsIfNotAsked(GaitRequest request, const FindOne& find) {
  request.carry_out = nullptr;
  if (request.reserve == Reserve::kRequired) return {FindWithReserve(request, find, {})};
  FoundGait without = find(request, {});
  return {without.gait ? FindWithReserve(request, find, without) : std::move(without)};
}

}  // namespace

FoundGait FindWithReserve(const GaitRequest& request, const FindOne& find,
                          const FoundGait& without) {
  FoundGait none = without;
  for (const Spare& spare : kFollowed) {
    GaitRequest asked = request;
    if (without.gait) {
      Bound(asked, kExpandedToFollow, kTimeToFollow);
    } else {
      asked.most_expanded /= static_cast<std::int64_t>(kFollowed.size());
    }
    FoundGait found = find(asked, {&spare, 1});
    const bool is_much_longer =
        found.gait && without.gait &&
        found.gait->stretches.size() > kTimesAsLong * without.gait->stretches.size() + kLonger;
    if (found.gait && !is_much_longer) return found;
    if (!none.gait && none.message.empty()) none.message = std::move(found.message);
  }
  return none;
}

TriedGait FindCarriedOut(const GaitRequest& request, const std::vector<grasp::Contact>& contacts,
                         const FindOne& find) {
  const bool is_required = request.reserve == Reserve::kRequired;
  const Deadline before_without =
      is_required ? request.deadline : request.deadline.After(kTimeBeforeWithout);
  TriedGait best{{}, false};
  TriedGait widest;
  bool has_found = false;
  for (const Look& look : LooksFor(request)) {
    if (look.is_again && !has_found) continue;
    GaitRequest asked = request;
    asked.seed += look.stream << kStreamShift;
    asked.deadline = before_without;
    if (look.is_whole) asked.carry_out = nullptr;
    Bound(asked, look.expanded, look.time);
    FoundGait found = find(asked, look.spares);
    has_found = found.gait.has_value();
    bool is_cut_short = false;
    if (has_found) {
      const auto carried = Try(*found.gait, request, contacts, before_without);
      if (!carried) return FindAsIfNotAsked(request, find);
      if (carried->is_whole) {
        if (!widest.is_carried_out || carried->spare > widest.spare) {
          widest = {std::move(found), true, carried->spare};
        }
        if (!request.seeks_most_spare || before_without.IsOver()) return widest;
        continue;
      }
      is_cut_short = carried->is_cut_short;
    }
    if (!best.found.gait && (found.gait || best.found.message.empty() || !look.is_whole)) {
      best.found = std::move(found);
      best.is_cut_short = is_cut_short;
    }
    if (before_without.IsOver()) break;
  }
  if (widest.is_carried_out) return widest;
  if (is_required) {
    if (!best.found.gait) return {std::move(best.found)};
    return {{std::nullopt,
             "of the gaits with reserve that were found the hand's motors carry none out"}};
  }
  TriedGait without{find(request, {}), false};
  if (without.found.gait) {
    const auto carried = Try(*without.found.gait, request, contacts, request.deadline);
    if (!carried) return FindAsIfNotAsked(request, find);
    if (carried->is_whole) return {std::move(without.found), true, carried->spare};
    without.is_cut_short = carried->is_cut_short;
  }
  TriedGait& chosen = best.found.gait ? best : without;
  if (!chosen.found.gait) return {std::move(chosen.found)};
  return std::move(chosen);
}

}  // namespace regrasp::gait
