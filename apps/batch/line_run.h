#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/line_output.h"
#include "apps/batch/line_records.h"

namespace regrasp::apps {

/// Callbacks of a run over the lines of a file.
struct LineWork {
  /// Return a key of the common inputs of lines that `prepare` treats alike. Must be cheap;
  /// consecutive lines usually have the same key.
  std::function<std::string(const Line&)> group;
  /// Called in the parent process before a line of another group is processed. Child processes
  /// inherit the data that it loads.
  std::function<void(const Line&)> prepare;
  /// Called in a child process. @returns the line of the result, without its line end.
  std::function<std::string(const Line&)> work;
  /// Compute a digest of all inputs of the result of a line (SealRecord), in the parent process.
  /// Without this function no result of an earlier run is reused.
  std::function<std::string(const Line&)> inputs = {};
  /// Called with an unmodified record of an earlier run that has the same digest.
  /// @returns true if the other output files of that result still exist. Without this function:
  ///     always true.
  std::function<bool(const Line&, std::string_view record)> complete = {};
  /// Return the lines that `work` printed on standard error when it created the record.
  std::function<std::vector<std::string>(const Line&, std::string_view record)> messages = {};
};

struct LineRunOptions {
  int jobs = 1;                        ///< number of concurrent processes, ≥ 1
  std::optional<double> time_limit_s;  ///< wall-clock time limit per entry, s
  /// Called for each entry that is bad input or an error, and for other messages of a child
  /// process.
  std::function<void(const std::string&)> on_message;
  std::function<void()> on_progress;  ///< called after entries were appended
};

/// Process all entries without a reusable result of an earlier run, and write all results in order.
/// An entry whose process crashes or exceeds the time limit becomes an error and does not stop the
/// others.
///
/// The same input gives the same bytes, regardless of the number of jobs and of interruptions.
/// Memory use grows with the number of jobs, not with the input: processes far ahead of a slow
/// entry wait.
/// @returns the signal that stopped the run, as RunInChildren; 0 if all entries are written.
[[nodiscard]] int RunLines(LinesInput& input, LinesOutput& output, const LineWork& work,
                           const LineRunOptions& options);

}  // namespace regrasp::apps
