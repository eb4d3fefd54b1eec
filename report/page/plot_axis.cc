#include "report/page/plot_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "planner/base/number.h"

namespace regrasp::report {

namespace {

/// More ticks than this crowd a plot.
constexpr int kMostTicks = 6;

/// A quotient this near to a whole number is one: 0.3 / 0.1 is a hair below 3.
constexpr double kWhole = 1e-9;

void CheckFinite(const std::vector<double>& values) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    throw std::invalid_argument("plot axis: a value is not finite");
  }
}

}  // namespace

double PlotAxis::Position(double value) const {
  const auto along = [&](double v) { return logarithmic ? std::log10(v) : v; };
  if (value <= lower) return 0;
  return std::min(1.0, (along(value) - along(lower)) / (along(upper) - along(lower)));
}

double RoundStep(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1 - kWhole)) return digit * power;
  }
  return 10 * power;
}

PlotAxis MakeLinearAxis(const std::vector<double>& values) {
  CheckFinite(values);
  double least = 0, most = 0;
  for (const double value : values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (most == least) most = least + 1;
  const double step = RoundStep((most - least) / (kMostTicks - 1));
  const auto first = static_cast<int>(std::floor(least / step + kWhole));
  const auto last = static_cast<int>(std::ceil(most / step - kWhole));
  PlotAxis axis = {first * step, last * step, /*logarithmic=*/false, {}};
  for (int i = first; i <= last; ++i) axis.ticks.push_back({i * step, FormatShort(i * step)});
  return axis;
}

PlotAxis MakeLogAxis(const std::vector<double>& values) {
  CheckFinite(values);
  double least = 0, most = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  if (most == 0) least = most = 1;
  const auto upper = static_cast<int>(std::ceil(std::log10(most) - kWhole));
  auto lower = static_cast<int>(std::floor(std::log10(least) + kWhole));
  lower = std::clamp(lower, upper - kMostDecades, upper - 1);
  PlotAxis axis = {std::pow(10.0, lower), std::pow(10.0, upper), /*logarithmic=*/true, {}};
  const int stride = (upper - lower + kMostTicks - 1) / kMostTicks;
  for (int exponent = upper; exponent >= lower; exponent -= stride) {
    axis.ticks.push_back({std::pow(10.0, exponent), FormatPowerOfTen(exponent)});
  }
  return axis;
}

std::string FormatPowerOfTen(int exponent) {
  static constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char c : std::to_string(exponent)) text += c == '-' ? "⁻" : kDigits[c - '0'];
  return text;
}

}  // namespace regrasp::report
