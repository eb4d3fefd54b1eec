#pragma once

#include <algorithm>
#include <vector>

namespace regrasp::bench {

/// Return the median; 0 without values.
[[nodiscard]] inline double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return (values[values.size() / 2] + values[(values.size() - 1) / 2]) / 2;
}

/// Return the largest value; 0 without values.
[[nodiscard]] inline double Largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

}  // namespace regrasp::bench
