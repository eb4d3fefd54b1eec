#include "bench/processor_clock.h"

#include <chrono>
#include <ctime>

namespace regrasp {
namespace {

using Clock = Deadline::Clock;

Clock::time_point Now() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return Clock::time_point(std::chrono::seconds(now.tv_sec) +
                           std::chrono::nanoseconds(now.tv_nsec));
}

}  // namespace

double ProcessorSeconds() {
  return std::chrono::duration<double>(Now().time_since_epoch()).count();
}

Deadline ProcessorDeadline(double seconds) {
  const std::chrono::duration<double> limit(seconds);
  return {Now() + std::chrono::duration_cast<Clock::duration>(limit), Now};
}

}  // namespace regrasp
