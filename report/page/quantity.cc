#include "report/page/quantity.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "report/page/plot_axis.h"

namespace regrasp::report {

namespace {

constexpr int kDigits = 3;

/// Numbers from here on, and below there, are written with a power of ten.
constexpr double kPlainFrom = 1e-3;
constexpr double kPlainTo = 1e6;

/// Less than an atom says nothing.
constexpr double kShortest_m = 1e-10;

constexpr char kNothing[] = "–";

/// The number without the zeros at its end, and without a point at its end.
std::string WithoutZeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::string NumberText(double value) {
  if (!std::isfinite(value)) return kNothing;
  if (value == 0) return "0";
  const double size = std::abs(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (size >= kPlainFrom && size < kPlainTo) {
    return WithoutZeros(FormatFixed(value, std::max(0, kDigits - 1 - exponent)));
  }
  const double mantissa = value / std::pow(10.0, exponent);
  return WithoutZeros(FormatFixed(mantissa, kDigits - 1)) + "\u00a0×\u00a0" +
         FormatPowerOfTen(exponent);
}

std::string LengthText(double metres) {
  if (!std::isfinite(metres)) return kNothing;
  if (metres < kShortest_m) return "0";
  std::string text = FormatLength(metres);
  return text.replace(text.find(' '), 1, "\u00a0");
}

}  // namespace regrasp::report
