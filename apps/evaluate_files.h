#pragma once

#include <string>

#include "apps/evaluate_lines.h"

namespace regrasp::apps {

/// Files of the results of `evaluate`, by format. Names of files that are not written are empty.
struct EvaluateFiles {
  /// JSON Lines. Without such a file on the command line, it is another output with the ending
  /// `.part`, and is removed when the others are written.
  std::string reports;
  bool keeps_reports = true;  ///< whether `reports` is an output of the command line
  std::string table;          ///< CSV
  std::string arrays;         ///< NPZ
  std::string page;           ///< HTML
};

/// Sort the outputs of the command line by format: .csv, .npz, .html or .htm, otherwise JSON Lines.
/// @throws InputError  if two outputs have the same format, or a shard has no output in JSON Lines.
[[nodiscard]] EvaluateFiles SortEvaluateOutputs(const EvaluateOptions& options);

/// Write table, arrays and page of a complete run, and print the counts unless `quiet`.
/// @throws InputError  if the file of reports is invalid, or too large for an NPZ file.
/// @throws EnvironmentError  if a file cannot be written.
void WriteEvaluateFiles(const EvaluateFiles& files, const EvaluateOptions& options);

}  // namespace regrasp::apps
