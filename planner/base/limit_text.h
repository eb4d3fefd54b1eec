#pragma once

#include <string>

namespace regrasp {

/// Texts of a measured value and of the limit that it is compared with.
struct LimitText {
  std::string value;
  std::string limit;
};

/// Format a value and its limit with `digits` significant digits, or as many more as it takes that
/// the texts differ if the numbers do: what exceeds its limit is never shown equal to it.
[[nodiscard]] LimitText FormatWithLimit(double value, double limit, int digits = 3);

/// The same of lengths in metres, each in the unit that suits it (FormatLength).
[[nodiscard]] LimitText FormatLengthWithLimit(double metres, double limit, int digits = 3);

/// The same of angles in degrees, with two decimals or more: "5.02°".
[[nodiscard]] LimitText FormatDegreesWithLimit(double degrees, double limit);

/// Format a smallest angle that is enough, in degrees without a unit: rounded up to a hundredth, so
/// that the number that is shown is enough, too. Bounds are computed to 1e-7°; what exceeds a
/// hundredth by less than 1e-6° is shown as that hundredth.
///
/// All programs, pages and pictures show required friction angles by this function.
[[nodiscard]] std::string FormatRequiredDegrees(double degrees);

/// The same with the angle that there is: both with as many more decimals as it takes that the
/// texts are ordered as the numbers are.
[[nodiscard]] LimitText FormatRequiredDegrees(double required, double available);

}  // namespace regrasp
