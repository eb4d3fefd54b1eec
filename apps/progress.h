#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// One line of progress on standard error that each report overwrites. Shown only when standard
/// error is a terminal and the user did not ask for quiet; cleared at the end.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Report(std::string_view text);
  /// Report, for work that is handed a function. This object outlives it.
  [[nodiscard]] std::function<void(std::string_view)> reporter() {
    return [this](std::string_view text) { Report(text); };
  }
  /// Removes the line, so that a message can take its place.
  void Clear();

 private:
  bool shown_;
  bool dirty_ = false;
};

/// Progress of minutes of work where standard error is no terminal but a log: a plain line now and
/// then. Shown only when the user did not ask for quiet.
class ProgressLog {
 public:
  using Clock = std::chrono::steady_clock;
  /// Between two lines, and before the first: short work writes none.
  static constexpr std::chrono::seconds kInterval{30};

  /// @param program  its name stands before every line.
  ProgressLog(std::string program, bool quiet, std::function<Clock::time_point()> now = Clock::now);

  /// Prints the text where a line is due.
  void Report(std::string_view text);

 private:
  std::string program_;
  bool shown_;
  std::function<Clock::time_point()> now_;
  Clock::time_point last_;
};

}  // namespace regrasp::apps
