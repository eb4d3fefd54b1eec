#pragma once

#include <string>

namespace regrasp::report {

/// A number for people, three significant digits: "0.364", "2120", "4.7 × 10⁻⁶". Trailing zeros
/// behind the point are left out. What is not finite is "–".
[[nodiscard]] std::string NumberText(double value);

/// A length in the unit that suits it (FormatLength), on one line: "4.1 µm", "10.4 cm"; "0" below a
/// tenth of a nanometre, "–" where it is not finite.
[[nodiscard]] std::string LengthText(double metres);

}  // namespace regrasp::report
