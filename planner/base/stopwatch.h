#pragma once

#include <chrono>

namespace regrasp {

/// Wall time, lap by lap.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since the watch was made.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace regrasp
