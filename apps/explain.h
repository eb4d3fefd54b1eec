#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// Value of --explain that prints all entries as Markdown.
/// These are the sections of docs/failure_reasons.md, then those of docs/likely_causes.md.
inline constexpr char kExplainAll[] = "all";

/// Add the option `--explain REASON`.
/// It is handled during parsing, before required options are checked. The text goes to standard
/// output, and the program exits with 0.
void AddExplain(CLI::App& app);

/// Return the text that `--explain` prints for a failure reason or likely cause.
///
/// @param name   failure reason or likely cause, for example "slipped", or `kExplainAll`.
/// @param width  maximum number of characters per line; ignored for `kExplainAll`.
/// @returns text that ends with a newline
/// @throws InputError  if there is no such reason; the message lists all
[[nodiscard]] std::string ExplainText(std::string_view name, int width);

}  // namespace regrasp::apps
