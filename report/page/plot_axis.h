#pragma once

#include <string>
#include <vector>

namespace regrasp::report {

struct PlotTick {
  double value = 0;
  std::string label;
};

/// The vertical axis of a plot: its ends and its ticks, all of them within the ends.
struct PlotAxis {
  double lower = 0;
  double upper = 1;
  bool logarithmic = false;
  std::vector<PlotTick> ticks;

  /// 0 at the lower end, 1 at the upper one; values beyond are held at the ends.
  [[nodiscard]] double Position(double value) const;
};

/// An axis from zero, or from below it, to a round number at or above all values.
/// @throws std::invalid_argument  a value is not finite.
[[nodiscard]] PlotAxis MakeLinearAxis(const std::vector<double>& values);

/// An axis of whole decades around all positive values, at least one and at most
/// kMostDecades; ticks at powers of ten.
/// @throws std::invalid_argument  a value is not finite.
[[nodiscard]] PlotAxis MakeLogAxis(const std::vector<double>& values);

/// What is smaller than the largest value by more than this lies on the axis's end.
inline constexpr int kMostDecades = 14;

/// "10⁻⁶".
[[nodiscard]] std::string FormatPowerOfTen(int exponent);

/// The smallest of 1, 2 or 5 times a power of ten that is no smaller than `least` (> 0).
[[nodiscard]] double RoundStep(double least);

}  // namespace regrasp::report
