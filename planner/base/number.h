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

/// Format a number for users with `digits` significant digits, without an exponent below a million.
[[nodiscard]] std::string FormatPlain(double value, int digits);

/// Format a length for users with `digits` significant digits, in a suitable unit.
/// Examples: "4.12 mm", "10.4 cm", "1 m", "300 µm".
[[nodiscard]] std::string FormatLength(double metres, int digits = 3);

/// Format a mass for users: "216 g", "1.4 kg".
[[nodiscard]] std::string FormatMass(double kg, int digits = 3);

/// Format an angle for users to a hundredth of a degree: "7.34°".
[[nodiscard]] std::string FormatDegrees(double degrees);

}  // namespace regrasp
