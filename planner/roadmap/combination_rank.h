#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace regrasp {

/// n over k for small k; 0 where n < k.
[[nodiscard]] constexpr std::int64_t Binomial(int n, int k) {
  if (n < k) return 0;
  std::int64_t value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// The rank of an ascending combination among all combinations of its size in colexicographic
/// order: Σ (c_i over i + 1), the combinatorial number system (Knuth, TAOCP 4A, 7.2.1.3).
///
/// Law: a bijection between the k-subsets of {0, …, n − 1} and {0, …, (n over k) − 1}.
template <std::size_t K>
[[nodiscard]] constexpr std::int64_t CombinationRank(const std::array<int, K>& ascending) {
  std::int64_t rank = 0;
  for (std::size_t i = 0; i < K; ++i) rank += Binomial(ascending[i], static_cast<int>(i) + 1);
  return rank;
}

}  // namespace regrasp
