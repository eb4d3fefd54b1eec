#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "apps/batch/line_run.h"

namespace regrasp::apps {

/// A run that reads a JSON Lines file and writes another one.
struct LinesRun {
  std::string program;  ///< name of the program, printed before its messages
  std::string content;  ///< content of the output: "plans" or "reports"
  std::filesystem::path input, output;
  std::string shard;  ///< value of --shard; empty: all lines
  /// Function that returns the SHA-256 of all inputs of the output's lines.
  /// `source` is the identity of the input's lines (LinesInput::source).
  std::function<std::string(const std::string& source)> digest;
  int jobs = 1;
  std::optional<double> time_limit_s;  ///< time limit of an entry
  bool fresh = false;
  bool quiet = false;
  LineWork work;
};

/// Run, or continue a stopped run, and print the number of entries per outcome.
/// Only the first messages about single entries are printed. The output has all of them.
///
/// @returns exit code of the worst entry: 0 for a plan, a pass, or an entry without a plan to
///     validate. 1 for no plan or a fail, 2 for bad input, 3 for an error. 128 plus the signal's
///     number if a signal stopped the run and this process is alive.
/// @throws InputError, EnvironmentError  as LinesInput and LinesOutput.
[[nodiscard]] int RunLinesFile(const LinesRun& run);

/// Process a line in a child process.
/// Exceptions for bad input or for a failure of the machine become the result.
[[nodiscard]] std::string GuardLine(const Line& line, const std::function<std::string()>& work);

}  // namespace regrasp::apps
