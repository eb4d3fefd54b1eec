#pragma once

#include <string>

namespace regrasp::apps {

/// Return the width of text on a stream, in characters.
/// It is COLUMNS, or the width of the terminal, or 80; at least 40 and at most 120.
/// @param stream  STDOUT_FILENO or STDERR_FILENO.
[[nodiscard]] int TextWidth(int stream);

/// Wrap a line of prose. Further lines are indented by two spaces more than the first.
/// Rows of tables, which have two spaces between cells, are not wrapped.
/// @param line  line without its line end.
/// @returns the lines, with line ends.
[[nodiscard]] std::string WrapForTerminal(const std::string& line, int width);

/// Arrange a result for a terminal: the verdict first, then the reasons, a blank line, and the rest
/// in its order. Prose is wrapped.
///
/// Scripts get the result unchanged, with the verdict in the last line.
/// @param text  result of FormatReportTable or FormatSummaryTable.
[[nodiscard]] std::string ArrangeForTerminal(const std::string& text, int width);

}  // namespace regrasp::apps
