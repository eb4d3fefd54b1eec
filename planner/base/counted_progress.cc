#include "planner/base/counted_progress.h"

#include <utility>

namespace regrasp {

namespace {

/// Reports of one piece of work.
constexpr std::int64_t kReports = 100;

}  // namespace

CountedProgress::CountedProgress(const Tell& tell, std::string what, std::int64_t total)
    : tell_(tell), what_(std::move(what)), total_(total) {
  Report();
}

void CountedProgress::Report() {
  // Rounded up, so that there are no more reports than that.
  next_ = done_ + (total_ + kReports - 1) / kReports;
  if (tell_) tell_(what_ + ": " + std::to_string(done_) + " of " + std::to_string(total_));
}

}  // namespace regrasp
