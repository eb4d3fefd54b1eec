#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp {

/// Convert degrees to radians. The library uses radians; files and options use degrees.
[[nodiscard]] constexpr double Radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double Degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// Unit of length for messages.
struct LengthUnit {
  double metres;
  const char* name;  ///< "mm"
};

/// Return the unit in which FormatLength prints a length with `digits` significant digits.
[[nodiscard]] LengthUnit UnitOfLength(double metres, int digits = 3);

/// Parse a whole string as a finite double, independently of the locale. A leading '+' is allowed.
/// @returns nullopt if the string is not a number, has trailing text, or is not finite.
[[nodiscard]] std::optional<double> ParseDouble(std::string_view text);

/// Format a double as the shortest decimal that is read back exactly, independently of the locale.
[[nodiscard]] std::string FormatDouble(double value);

/// Format a double for tables with `decimals` decimals, independently of the locale.
/// @pre |value| < 1e15
[[nodiscard]] std::string FormatFixed(double value, int decimals);

/// Format a double for users with `digits` significant digits, independently of the locale.
[[nodiscard]] std::string FormatShort(double value, int digits = 4);

/// Format a number with `digits` significant digits, without exponent from 1e-12 up to a million.
[[nodiscard]] std::string FormatPlain(double value, int digits);

/// Format a length for users with `digits` significant digits, in a suitable unit.
/// Examples: "4.12 mm", "10.4 cm", "1 m", "300 µm".
[[nodiscard]] std::string FormatLength(double metres, int digits = 3);

/// Format a mass for users: "216 g", "1.4 kg".
[[nodiscard]] std::string FormatMass(double kg, int digits = 3);

/// Format an angle for users to a hundredth of a degree: "7.34°".
[[nodiscard]] std::string FormatDegrees(double degrees);

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
