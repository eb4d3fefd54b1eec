#include "planner/gait/crowding.h"

namespace regrasp::gait {
namespace {

/// Steps for each rest that ends at the same one.
constexpr double kAtOneStep = 0.1;
/// For each one of the same kind.
constexpr double kAlike = 0.5;
/// For each one that the same fingers hold: there is much to slide to with three fingers, and most
/// of it leads nowhere.
constexpr double kSameFingers = 0.3;

std::vector<bool> WhoHolds(const Holding& holding) {
  std::vector<bool> holds;
  for (const int point : holding) holds.push_back(point != kNone);
  return holds;
}

template <class Key>
int CountOf(const std::map<Key, int>& counts, const Key& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

void Crowding::Count(const Holding& holding, int step) {
  ++at_[step];
  ++like_[kinds_.KindOf(holding)];
  ++with_[WhoHolds(holding)];
}

double Crowding::PutBack(double score, const Holding& holding, int step) const {
  return score - kAtOneStep * at_[step] - kAlike * CountOf(like_, kinds_.KindOf(holding)) -
         kSameFingers * CountOf(with_, WhoHolds(holding));
}

}  // namespace regrasp::gait
