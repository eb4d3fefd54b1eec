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

/// Of turns of ten bodies in five hands nearly all of the first kind are carried out, and a tenth
/// to two thirds of the second and third, which are found in a tenth of the time. The last has some
/// where the others have none.
constexpr std::array kSpares = {Spare{0.05, 1.5e-3, 0.2}, Spare{0.05, 0.5e-3}, Spare{0.02, 0},
                                Spare{0.02, 1.5e-3, 0.1}};
/// What is spent on each of them where there is another gait or others follow: grasps that are
/// expanded, by round and for each quarter turn, and share of the time that is left.
constexpr std::array<std::int64_t, 8> kExpandedInRound = {40, 80, 160, 160, 160, 160, 160, 160};
constexpr double kTimeWithReserve = 0.4;
constexpr int kRoundShift = 32;  ///< of seeds
/// With it a gait may have so many times as many stretches as without, and so many more.
constexpr std::size_t kTimesAsLong = 3;
constexpr std::size_t kLonger = 12;

/// Looks for gaits until one is carried out.
class ReserveSearch {
 public:
  ReserveSearch(const GaitRequest& request, const std::vector<grasp::Contact>& contacts,
                const FindOne& find, const FoundGait& without)
      : request_(request), contacts_(contacts), find_(find), without_(without), best_(without) {}

  std::optional<bool> Run() {
    const int rounds = is_tried() ? static_cast<int>(kExpandedInRound.size()) : 1;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t kind = 0; kind < kSpares.size(); ++kind) {
        const Spare& spare = kSpares[kind];
        if (!spare.force_margin && !is_tried()) continue;
        // What found nothing has its turn in the round after the next.
        if (std::exchange(has_failed_[kind], false)) continue;
        FoundGait other = find_(Asked(spare, round), &spare);
        has_failed_[kind] = !other.gait;
        if (!other.gait && !best_.gait && best_.message.empty()) best_ = std::move(other);
        if (other.gait && !IsMuchLonger(*other.gait) && IsTaken(std::move(other))) return carried_;
      }
      if (round == 0 && without_.gait && IsTaken(without_)) return carried_;
      if (request_.deadline.IsOver()) break;
    }
    return best_.gait ? carried_ : std::nullopt;
  }

  [[nodiscard]] FoundGait TakeBest() { return std::move(best_); }

 private:
  [[nodiscard]] bool is_tried() const { return request_.is_carried_out != nullptr; }

  [[nodiscard]] GaitRequest Asked(const Spare& spare, int round) const {
    GaitRequest asked = request_;
    asked.seed += static_cast<std::uint64_t>(round) << kRoundShift;
    asked.criteria.min_quality = std::max(asked.criteria.min_quality, spare.quality);
    asked.margin += spare.clearance;
    if (without_.gait || is_tried()) {
      asked.most_expanded = std::min(asked.most_expanded, ExpandedIn(round));
      asked.deadline = asked.deadline.After(kTimeWithReserve);
    } else {
      asked.most_expanded /= 2;
    }
    return asked;
  }

  [[nodiscard]] std::int64_t ExpandedIn(int round) const {
    const double quarters = std::max(1.0, std::abs(request_.turn.angle) / (std::numbers::pi / 2));
    return std::llround(quarters * static_cast<double>(kExpandedInRound[round]));
  }

  [[nodiscard]] bool IsMuchLonger(const Gait& gait) const {
    return without_.gait &&
           gait.stretches.size() > kTimesAsLong * without_.gait->stretches.size() + kLonger;
  }

  /// Tries a gait. @returns whether the hand carries it out, or nothing tells.
  bool IsTaken(FoundGait found) {
    if (is_tried()) {
      request_.progress("trying a plan on the hand's own motors");
      carried_ = request_.is_carried_out(PlanOf(*found.gait, request_, contacts_));
    }
    const bool is_taken = carried_.value_or(true);
    if (is_taken || !has_spare_) best_ = std::move(found);
    has_spare_ = true;
    return is_taken;
  }

  const GaitRequest& request_;
  const std::vector<grasp::Contact>& contacts_;
  const FindOne& find_;
  const FoundGait& without_;
  FoundGait best_;
  std::optional<bool> carried_;
  bool has_spare_ = false;
  std::array<bool, kSpares.size()> has_failed_ = {};  ///< in the round before
};

}  // namespace

std::optional<bool> FindWithReserve(const GaitRequest& request,
                                    const std::vector<grasp::Contact>& contacts,
                                    const FindOne& find, FoundGait& found) {
  const FoundGait without = std::move(found);
  ReserveSearch search(request, contacts, find, without);
  const std::optional<bool> carried = search.Run();
  found = search.TakeBest();
  if (request.reserve == Reserve::kRequired && found.gait && carried == false) {
    found = {std::nullopt,
             "of the gaits with reserve that were found the hand's motors carry none out"};
    return std::nullopt;
  }
  return carried;
}

}  // namespace regrasp::gait
