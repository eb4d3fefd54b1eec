#include "planner/base/limit_text.h"

#include <cmath>

#include "planner/base/number.h"

namespace regrasp {

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
