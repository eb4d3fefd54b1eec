#pragma once

#include <string>

namespace regrasp {

/// Formatted value and the limit that it is compared with.
struct LimitText {
  std::string value;
  std::string limit;
};

/// Format a value and its limit such that different numbers have different texts.
/// Both have `digits` significant digits, or more if the texts would be equal. A value beyond its
/// limit is therefore never shown as equal to it.
[[nodiscard]] LimitText FormatWithLimit(double value, double limit, int digits = 3);

/// Format a length and its limit as FormatWithLimit, in metres. Each has the unit of FormatLength.
[[nodiscard]] LimitText FormatLengthWithLimit(double metres, double limit, int digits = 3);

/// Format an angle and its limit in degrees, as FormatWithLimit: "5.02°".
/// They have at least two decimals.
[[nodiscard]] LimitText FormatDegreesWithLimit(double degrees, double limit);

/// Format a required angle in degrees, without a unit, rounded up to a hundredth.
/// The printed angle is therefore sufficient, too. Bounds are computed to 1e-7°. A value that
/// exceeds a hundredth by less than 1e-6° is rounded down.
///
/// All programs, reports and images format required friction angles by this function.
[[nodiscard]] std::string FormatRequiredDegrees(double degrees);

/// Format a required and an available angle, in degrees.
/// They have additional decimals if their texts would be in the wrong order.
[[nodiscard]] LimitText FormatRequiredDegrees(double required, double available);

}  // namespace regrasp
