#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regrasp {

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

}  // namespace regrasp
