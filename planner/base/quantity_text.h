#pragma once

#include <string>

namespace regrasp {

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
