#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp {

/// Angles are radians everywhere inside the library, degrees in files and on the command line.
[[nodiscard]] constexpr double Radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double Degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// A unit that lengths are told in.
struct LengthUnit {
  double metres;
  const char* name;  ///< "mm"
};

/// The unit that suits a length of `metres`, told with so many significant digits: the one that
/// FormatLength (quantity_text.h) tells it in.
[[nodiscard]] LengthUnit UnitOfLength(double metres, int digits = 3);

/// Reads a whole string as a finite double, the same under any locale. A leading '+' is allowed.
/// @returns nullopt where it is not a number, has other text behind it, or is not finite.
[[nodiscard]] std::optional<double> ParseDouble(std::string_view text);

/// The shortest decimal that reads back as the same double, the same under any locale.
[[nodiscard]] std::string FormatDouble(double value);

/// A double for tables: `decimals` digits behind the point, the same under any locale.
/// @pre |value| < 1e15
[[nodiscard]] std::string FormatFixed(double value, int decimals);

/// A double for people: `digits` significant digits, the same under any locale.
[[nodiscard]] std::string FormatShort(double value, int digits = 4);

/// A number for people: `digits` significant ones, and no power of ten below a million.
[[nodiscard]] std::string FormatPlain(double value, int digits);

/// A length for people, in the unit that suits it: "4.12 mm", "10.4 cm", "1 m", "300 µm"; `digits`
/// significant ones.
[[nodiscard]] std::string FormatLength(double metres, int digits = 3);

/// A mass for people: "216 g", "1.4 kg".
[[nodiscard]] std::string FormatMass(double kg, int digits = 3);

/// An angle for people, to a hundredth of a degree: "7.34°".
[[nodiscard]] std::string FormatDegrees(double degrees);

}  // namespace regrasp
