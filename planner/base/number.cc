#include "planner/base/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace regrasp {

std::optional<double> ParseDouble(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string FormatDouble(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string FormatFixed(double value, int decimals) {
  std::array<char, 64> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          std::chars_format::fixed, decimals);
  return {text.data(), end};
}

std::string FormatShort(double value, int digits) {
  std::array<char, 64> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          std::chars_format::general, digits);
  return {text.data(), end};
}

namespace {

constexpr int kAngleDecimals = 2;

constexpr LengthUnit kLengths[] = {{1e3, "km"},  {1, "m"},     {1e-2, "cm"},
                                   {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}};

struct MassUnit {
  double kg;
  const char* name;
};
constexpr MassUnit kMasses[] = {{1, "kg"}, {1e-3, "g"}, {1e-6, "mg"}, {1e-9, "µg"}};

/// Return the largest unit in which the rounded value is at least 1, otherwise the last unit.
template <class Unit>
Unit UnitOf(double value, int digits, std::span<const Unit> units, double Unit::*size) {
  const double one = 1 - std::pow(10.0, -digits) / 2;
  const auto fits =
      std::ranges::find_if(units, [&](const Unit& unit) { return value / unit.*size >= one; });
  return fits == units.end() ? units.back() : *fits;
}

}  // namespace

LengthUnit UnitOfLength(double metres, int digits) {
  return UnitOf<LengthUnit>(metres, digits, kLengths, &LengthUnit::metres);
}

std::string FormatPlain(double value, int digits) {
  constexpr double kLargest = 1e6, kUsual = 1e-3, kSmallest = 1e-12;
  if (std::abs(value) >= kSmallest && std::abs(value) < kUsual) {
    const int place = static_cast<int>(std::floor(std::log10(std::abs(value))));
    std::string text = FormatFixed(value, digits - 1 - place);
    text.erase(text.find_last_not_of('0') + 1);
    return text;
  }
  // Numbers that round up to one more digit already have that digit.
  if (!(std::abs(value) >= std::pow(10.0, digits) - 0.5) || std::abs(value) >= kLargest) {
    return FormatShort(value, digits);
  }
  const double place = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return FormatFixed(std::round(value / place) * place, 0);
}

std::string FormatLength(double metres, int digits) {
  const LengthUnit unit = UnitOfLength(metres, digits);
  return FormatPlain(metres / unit.metres, digits) + " " + unit.name;
}

std::string FormatMass(double kg, int digits) {
  const MassUnit unit = UnitOf<MassUnit>(kg, digits, kMasses, &MassUnit::kg);
  return FormatPlain(kg / unit.kg, digits) + " " + unit.name;
}

std::string FormatDegrees(double degrees) { return FormatFixed(degrees, kAngleDecimals) + "°"; }

namespace {

/// Number of digits that distinguishes any two doubles.
constexpr int kMostDigits = 17;
constexpr int kMostDecimals = 30;
constexpr int kUsualDecimals = 2;
/// Slack of bounds on required angles, degrees; the bounds are about 6e-8° apart.
constexpr double kBoundSlack = 1e-6;

/// Format two numbers with equally many digits, such that different numbers have different texts.
/// @param format  function of a number and a number of digits, which is at least `digits`.
template <class Format>
LimitText FormatApart(double value, double limit, int digits, int most, const Format& format) {
  LimitText text{format(value, digits), format(limit, digits)};
  for (int more = digits + 1; value != limit && text.value == text.limit && more <= most; ++more) {
    text = {format(value, more), format(limit, more)};
  }
  return text;
}

std::string FormatDegreesSign(double degrees, int decimals) {
  return FormatFixed(degrees, decimals) + "°";
}

std::string FormatUp(double degrees, int decimals, double slack) {
  const double steps = std::pow(10.0, decimals);
  return FormatFixed(std::ceil((degrees - slack) * steps) / steps + 0.0, decimals);
}

}  // namespace

LimitText FormatWithLimit(double value, double limit, int digits) {
  return FormatApart(value, limit, digits, kMostDigits,
                     [](double number, int more) { return FormatShort(number, more); });
}

LimitText FormatLengthWithLimit(double metres, double limit, int digits) {
  return FormatApart(metres, limit, digits, kMostDigits,
                     [](double length, int more) { return FormatLength(length, more); });
}

LimitText FormatDegreesWithLimit(double degrees, double limit) {
  return FormatApart(degrees, limit, kUsualDecimals, kMostDecimals, FormatDegreesSign);
}

std::string FormatRequiredDegrees(double degrees) {
  return FormatUp(degrees, kUsualDecimals, kBoundSlack);
}

LimitText FormatRequiredDegrees(double required, double available) {
  LimitText text{FormatRequiredDegrees(required), FormatFixed(available, kUsualDecimals)};
  const bool enough = required <= available;
  for (int decimals = kUsualDecimals + 1; decimals <= kMostDecimals; ++decimals) {
    const bool shown = *ParseDouble(text.value) <= *ParseDouble(text.limit);
    if (shown == enough) break;
    text = {FormatUp(required, decimals, 0), FormatFixed(available, decimals)};
  }
  return text;
}

}  // namespace regrasp
