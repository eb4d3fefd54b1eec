#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// A line of progress on standard error that each report overwrites.
/// It is shown only on a terminal and without --quiet. The destructor clears it.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Report(std::string_view text);
  /// Return the function Report, for work that takes a function.
  /// This object must outlive it.
  [[nodiscard]] std::function<void(std::string_view)> reporter() {
    return [this](std::string_view text) { Report(text); };
  }
  /// Remove the line, so that a message can be printed in its place.
  void Clear();

 private:
  bool shown_;
  bool dirty_ = false;
};

/// Progress of long work, if standard error is a log instead of a terminal.
/// It prints a plain line at intervals, unless --quiet is given.
class ProgressLog {
 public:
  using Clock = std::chrono::steady_clock;
  /// Time between two lines, and before the first one. Short work prints none.
  static constexpr std::chrono::seconds kInterval{30};

  /// @param program  name that starts every line.
  ProgressLog(std::string program, bool quiet, std::function<Clock::time_point()> now = Clock::now);

  /// Print the text if a line is due.
  void Report(std::string_view text);

 private:
  std::string program_;
  bool shown_;
  std::function<Clock::time_point()> now_;
  Clock::time_point last_;
};

}  // namespace regrasp::apps
