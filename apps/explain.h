#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <string_view>

#include "planner/plan/failure_reasons.h"

namespace regrasp::apps {

/// Value of --explain that prints all entries as Markdown.
/// These are the sections of docs/failure_reasons.md, then those of docs/likely_causes.md.
inline constexpr char kExplainAll[] = "all";

/// Failure reasons of a program other than validate.
struct ReasonReference {
  std::span<const plan::FailureReason> reasons;
  std::string check;  ///< name of the check of all reasons, printed after their names
  std::string page;   ///< page of the documents with an anchor per reason, without ending
};

/// Add the option `--explain REASON`.
/// It is handled during parsing, before required options are checked. The text goes to standard
/// output, and the program exits with 0. It explains the reasons of validate.
void AddExplain(CLI::App& app);
/// Add the same option for the reasons of another program.
void AddExplain(CLI::App& app, const ReasonReference& reference);

/// Return the text that `--explain` prints for a failure reason or likely cause of validate.
///
/// @param name   failure reason or likely cause, for example "slipped", or `kExplainAll`.
/// @param width  maximum number of characters per line; ignored for `kExplainAll`.
/// @returns text that ends with a newline
/// @throws InputError  if there is no such reason; the message lists all
[[nodiscard]] std::string ExplainText(std::string_view name, int width);
/// Return the same text for a failure reason of another program.
[[nodiscard]] std::string ExplainText(const ReasonReference& reference, std::string_view name,
                                      int width);

}  // namespace regrasp::apps
