#pragma once

#include <string>

namespace regrasp::report {

/// A number for people, three significant digits: "0.364", "2120", "4.7 × 10⁻⁶". Trailing zeros
/// behind the point are left out. What is not finite is "–".
[[nodiscard]] std::string NumberText(double value);

/// A length in the unit that suits it: "4.1 µm", "104 mm"; "0" below a tenth of a nanometre.
[[nodiscard]] std::string LengthText(double metres);

/// An angle to a hundredth of a degree: "12.40°".
[[nodiscard]] std::string DegreesText(double degrees);

}  // namespace regrasp::report
