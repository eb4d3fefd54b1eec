#pragma once

#include <algorithm>
#include <vector>

namespace regrasp::bench {

/// 0 of none.
[[nodiscard]] inline double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return (values[values.size() / 2] + values[(values.size() - 1) / 2]) / 2;
}

/// 0 of none.
[[nodiscard]] inline double Largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

}  // namespace regrasp::bench
