#include "apps/progress.h"

#include <unistd.h>

#include <iostream>
#include <string>
#include <utility>

#include "apps/program.h"
#include "planner/base/text_table.h"

namespace regrasp::apps {

namespace {

/// Return to the first column, and erase to the end of the line (ECMA-48 EL).
const std::string kEraseLine = "\r\x1b[K";

}  // namespace

ProgressLine::ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::Report(std::string_view text) {
  if (!shown_) return;
  std::cerr << kEraseLine + OneLine(text) << std::flush;
  dirty_ = true;
}

void ProgressLine::Clear() {
  if (dirty_) std::cerr << kEraseLine << std::flush;
  dirty_ = false;
}

ProgressLog::ProgressLog(std::string program, bool quiet, std::function<Clock::time_point()> now)
    : program_(std::move(program)),
      shown_(!quiet && isatty(STDERR_FILENO) != 1),
      now_(std::move(now)),
      last_(now_()) {}

void ProgressLog::Report(std::string_view text) {
  if (!shown_ || now_() < last_ + kInterval) return;
  PrintMessage(program_, text);
  last_ = now_();
}

}  // namespace regrasp::apps
