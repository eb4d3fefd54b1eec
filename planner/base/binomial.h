#pragma once

namespace regrasp {

/// An interval for an unknown share.
struct ShareInterval {
  double lower = 0;
  double upper = 1;
};

/// The exact confidence interval for the share of successes of which `successes` of `trials`
/// independent trials were seen (Clopper and Pearson 1934): each end leaves out no more than
/// (1 − confidence) / 2.
/// @throws std::invalid_argument  not 0 ≤ successes ≤ trials, trials < 1, or the confidence is not
///                                in (0, 1).
[[nodiscard]] ShareInterval ComputeShareInterval(int successes, int trials, double confidence);

}  // namespace regrasp
