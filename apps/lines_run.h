#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "apps/batch/line_run.h"

namespace regrasp::apps {

/// A run over a file of lines that writes another one.
struct LinesRun {
  std::string program;  ///< its name, before its messages
  std::string content;  ///< of the output: "plans" or "reports"
  std::filesystem::path input, output;
  std::string shard;  ///< as the option says it; empty: all
  /// SHA-256 of all that the output's lines come from, of what its input's lines do.
  std::function<std::string(const std::string& source)> digest;
  int jobs = 1;
  std::optional<double> time_limit_s;  ///< of an entry
  bool fresh = false;
  bool quiet = false;
  LineWork work;
};

/// Runs it, or goes on where an earlier run was stopped, and says how many entries came to what. Of
/// what is said of single entries the first messages are printed; all stand in the output.
///
/// @returns the exit code of the worst entry: 0 a plan, a pass, or one that had no plan to
/// validate; 1 no plan or a fail, 2 bad input, 3 an error; 128 and its number where a signal
/// stopped the run and left this process alive.
/// @throws InputError, EnvironmentError  as LinesInput and LinesOutput.
[[nodiscard]] int RunLinesFile(const LinesRun& run);

/// Works on a line in a child: what is thrown for bad input, or because the machine fails, becomes
/// the result.
[[nodiscard]] std::string GuardLine(const Line& line, const std::function<std::string()>& work);

}  // namespace regrasp::apps
