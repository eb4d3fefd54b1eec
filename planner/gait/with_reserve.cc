#include "planner/gait/with_reserve.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "planner/gait/plan_of_gait.h"

namespace regrasp::gait {
namespace {

/// Of turns of ten bodies in five hands nearly all of the first kind are carried out, of the second
/// more than of those without reserve.
constexpr std::array kSpares = {Spare{0.2, 0.05}, Spare{0.1, 0.02}};
/// What links keep off beside the margin, metres.
constexpr double kMoreClearance = 1.5e-3;
/// What is spent on each of them where there is another gait: grasps that are expanded, share of
/// the time that is left.
constexpr std::int64_t kExpandedWithReserve = 200;
constexpr double kTimeWithReserve = 0.5;
/// Times that they are looked for, where the hand does not carry them out.
constexpr int kRounds = 3;
constexpr int kRoundShift = 32;  ///< of seeds
/// With it a gait may have so many times as many stretches as without, and so many more.
constexpr std::size_t kTimesAsLong = 3;
constexpr std::size_t kLonger = 12;

/// @param round  each draws others.
GaitRequest WithReserve(GaitRequest request, const Spare& spare, int round) {
  request.seed += static_cast<std::uint64_t>(round) << kRoundShift;
  double& quality = request.criteria.min_quality;
  quality = std::max(quality, spare.quality);
  request.margin += kMoreClearance;
  if (request.reserve == Reserve::kRequired && round == 0) {
    if (&spare == &kSpares.back()) return request;
    request.most_expanded /= 2;
  } else {
    request.most_expanded = std::min(request.most_expanded, kExpandedWithReserve);
  }
  request.deadline = request.deadline.After(kTimeWithReserve);
  return request;
}

bool IsMuchLonger(const Gait& gait, const Gait& other) {
  return gait.stretches.size() > kTimesAsLong * other.stretches.size() + kLonger;
}

}  // namespace

std::optional<bool> FindWithReserve(const GaitRequest& request,
                                    const std::vector<grasp::Contact>& contacts,
                                    const FindOne& find, FoundGait& found) {
  const FoundGait without = found;
  const bool is_required = request.reserve == Reserve::kRequired;
  const auto is_carried_out = [&](const Gait& gait) -> std::optional<bool> {
    if (!request.is_carried_out) return std::nullopt;
    request.progress("trying a plan on the hand's own motors");
    return request.is_carried_out(PlanOf(gait, request, contacts));
  };
  bool has_spare = false;
  for (int round = 0; round < kRounds; ++round) {
    for (const Spare& spare : kSpares) {
      FoundGait other = find(WithReserve(request, spare, round), &spare);
      if (is_required && !has_spare && !other.gait) found.message = other.message;
      if (!other.gait || (without.gait && IsMuchLonger(*other.gait, *without.gait))) continue;
      const std::optional<bool> carried = is_carried_out(*other.gait);
      if (carried.value_or(true)) {
        found = std::move(other);
        return carried;
      }
      if (!has_spare) found = std::move(other);
      has_spare = true;
    }
    if (round == 0 && without.gait) {
      const std::optional<bool> carried = is_carried_out(*without.gait);
      if (carried.value_or(true)) {
        found = without;
        return carried;
      }
    }
    const bool is_hopeless = is_required && !has_spare;
    if (is_hopeless || !request.is_carried_out || request.deadline.IsOver()) break;
  }
  if (!found.gait) return std::nullopt;
  if (is_required) {
    found = {std::nullopt,
             "of the gaits with reserve that were found the hand's motors carry none out"};
  }
  return false;
}

}  // namespace regrasp::gait
