#pragma once

#include <memory>

#include "planner/base/deadline.h"

namespace regrasp {

/// A deadline by a clock that goes on by an hour at every look: it comes at the `last`-th one.
class CountedDeadline {
 public:
  explicit CountedDeadline(int last = 1'000'000) : last_(last) {}

  [[nodiscard]] Deadline deadline() const {
    const auto time = [](int looks) {
      return Deadline::Clock::time_point(std::chrono::hours(looks));
    };
    return {time(last_), [time, looks = looks_] { return time(++*looks); }};
  }
  [[nodiscard]] int looks() const { return *looks_; }

 private:
  int last_;
  std::shared_ptr<int> looks_ = std::make_shared<int>(0);
};

}  // namespace regrasp
