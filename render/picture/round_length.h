#pragma once

#include <string>

namespace regrasp::render {

/// The longest of 1, 2 or 5 times a power of ten that is no longer than `limit` (> 0).
[[nodiscard]] double RoundLength(double limit);

/// A length for people, in the unit that suits it: "5 mm", "2 cm", "1 m"; `digits`
/// significant ones.
[[nodiscard]] std::string FormatLength(double metres, int digits = 4);

}  // namespace regrasp::render
