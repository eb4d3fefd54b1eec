#pragma once

#include <algorithm>
#include <vector>

namespace regrasp::gait {

/// By finger: the contact that it holds, by number; kNone where it is free.
using Holding = std::vector<int>;
inline constexpr int kNone = -1;

/// How many fingers hold.
[[nodiscard]] inline int CountHolding(const Holding& holding) {
  return static_cast<int>(std::ranges::count_if(holding, [](int point) { return point != kNone; }));
}

[[nodiscard]] inline bool Holds(const Holding& holding, int point) {
  return std::ranges::find(holding, point) != holding.end();
}

/// Calls `take` with each way to have fingers hold the points, one finger each.
/// @pre no more points than fingers.
template <class Take>
void ForEachAssignment(const std::vector<int>& points, int fingers, const Take& take) {
  std::vector<int> order(fingers, kNone);
  std::ranges::copy(points, order.begin());
  std::ranges::sort(order);
  do {
    take(Holding(order));
  } while (std::ranges::next_permutation(order).found);
}

}  // namespace regrasp::gait
