#pragma once

#include <string>
#include <string_view>

namespace regrasp {

/// One line of progress on standard error that each report overwrites. Shown only when standard
/// error is a terminal and the user did not ask for quiet; cleared at the end.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Report(std::string_view text);
  /// Removes the line, so that a message can take its place.
  void Clear();

 private:
  bool shown_;
  bool dirty_ = false;
};

}  // namespace regrasp
