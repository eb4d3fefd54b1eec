#pragma once

#include <string>

namespace regrasp::apps {

/// Whether what is printed on a stream may have colour: it is a terminal, not a dumb one, and
/// NO_COLOR is not set to anything (no-color.org).
/// @param stream  STDOUT_FILENO or STDERR_FILENO.
[[nodiscard]] bool TakesColour(int stream);

enum class Ink { kRed = 31, kGreen = 32, kYellow = 33, kFaint = 2 };

/// Text in a colour (ECMA-48 SGR).
[[nodiscard]] std::string Paint(const std::string& text, Ink ink);

/// A table with its verdicts in colours: passes green, failures and errors red, skipped faint.
[[nodiscard]] std::string PaintVerdicts(const std::string& table);

}  // namespace regrasp::apps
