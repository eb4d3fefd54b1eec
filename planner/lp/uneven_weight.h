#pragma once

#include <cmath>

namespace regrasp::lp {

/// Return a weight in [1, 1.5), different for each i.
/// Multiples of the golden ratio modulo 1 never repeat. In symmetric programs many basic weights
/// would be zero at the same time. A right-hand side that is a sum with uneven weights avoids these
/// degenerate pivots (the perturbation of Charnes 1952, with fixed numbers).
[[nodiscard]] inline double UnevenWeight(int i) {
  const double turns = i * 0.6180339887498949;
  return 1 + 0.5 * (turns - std::floor(turns));
}

}  // namespace regrasp::lp
