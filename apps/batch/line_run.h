#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/line_input.h"
#include "apps/batch/line_output.h"

namespace regrasp::apps {

/// What a run does with each of many lines.
struct LineWork {
  /// What lines have in common for which `prepare` does the same, cheaply told; neighbours mostly.
  std::function<std::string(const Line&)> group;
  /// Called in this process before a line of another group is worked on: what it loads all children
  /// have from then on.
  std::function<void(const Line&)> prepare;
  /// Called in a child process. @returns the line of its result, without its end.
  std::function<std::string(const Line&)> work;
  /// Compute a digest of all that the result of a line depends on (SealRecord), in this process;
  /// if there is no such function, no result of an earlier run is reused.
  std::function<std::string(const Line&)> inputs = {};
  /// Called with the record of an earlier run that is as it was written and has the same digest.
  /// @returns whether what it has left besides is still there; no such function: always.
  std::function<bool(const Line&, std::string_view record)> complete = {};
  /// Return what `work` printed on standard error when it made the record, line by line.
  std::function<std::vector<std::string>(const Line&, std::string_view record)> messages = {};
};

struct LineRunOptions {
  int jobs = 1;                        ///< processes at a time, ≥ 1
  std::optional<double> time_limit_s;  ///< of an entry, seconds by the clock
  /// Told about each entry that is bad input or an error, and what a child says besides.
  std::function<void(const std::string&)> on_message;
  std::function<void()> on_progress;  ///< called whenever entries were appended
};

/// Works on all entries of the input that have no result of an earlier run with the same inputs,
/// and writes all results in order. An entry whose process crashes or takes too long becomes an
/// error and stops no other.
///
/// The same input gives the same bytes, whatever the number of jobs and wherever an earlier run was
/// stopped. Memory grows with the jobs, not with the input: who is far ahead of a slow entry waits.
/// @returns the signal that stopped it, as RunInChildren; 0 where all entries are there.
[[nodiscard]] int RunLines(LinesInput& input, LinesOutput& output, const LineWork& work,
                           const LineRunOptions& options);

}  // namespace regrasp::apps
