#pragma once

#include <string>

namespace regrasp::apps {

/// Return whether text on a stream may have colour.
/// The stream must be a terminal that is not dumb, and NO_COLOR must be unset or empty
/// (no-color.org).
/// @param stream  STDOUT_FILENO or STDERR_FILENO.
[[nodiscard]] bool TakesColour(int stream);

enum class Ink { kRed = 31, kGreen = 32, kYellow = 33, kFaint = 2 };

/// Return text in a colour (ECMA-48 SGR).
[[nodiscard]] std::string Paint(const std::string& text, Ink ink);

/// Colour the verdicts of a table: pass green, fail and error red, skipped faint.
[[nodiscard]] std::string PaintVerdicts(const std::string& table);

}  // namespace regrasp::apps
