#pragma once

#include <array>
#include <cstdint>

namespace regrasp::roadmap {

/// n over K; 0 where n < K. A template, so that the divisions are by constants.
template <int K>
[[nodiscard]] constexpr std::int64_t Binomial(int n) {
  if constexpr (K == 0) {
    return 1;
  } else {
    return Binomial<K - 1>(n) * (n - K + 1) / K;
  }
}

/// The rank of an ascending triple among all triples in colexicographic order: Σ (c_i over i + 1),
/// the combinatorial number system (Knuth, TAOCP 4A, 7.2.1.3).
///
/// Law: a bijection between the triples of {0, …, n − 1} and {0, …, (n over 3) − 1}.
[[nodiscard]] constexpr std::int64_t CombinationRank(const std::array<int, 3>& ascending) {
  return Binomial<1>(ascending[0]) + Binomial<2>(ascending[1]) + Binomial<3>(ascending[2]);
}

}  // namespace regrasp::roadmap
