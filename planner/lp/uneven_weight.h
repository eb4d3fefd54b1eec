#pragma once

#include <cmath>

namespace regrasp::lp {

/// Weights in [1, 1.5) of which no two are the same: multiples of the golden ratio, modulo 1, never
/// repeat. A right-hand side that is a sum with such weights makes symmetric programs, where many
/// basic weights would be zero at once, cause no degenerate pivots (the perturbation of Charnes
/// 1952, with fixed numbers).
[[nodiscard]] inline double UnevenWeight(int i) {
  const double turns = i * 0.6180339887498949;
  return 1 + 0.5 * (turns - std::floor(turns));
}

}  // namespace regrasp::lp
