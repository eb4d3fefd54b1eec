#pragma once

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace regrasp {

/// Bytes of resident memory that a task takes at most, run in a child process of its own: memory
/// that this process has given back must not serve it. 0 where it does not come to its end.
inline double PeakBytesOf(const std::function<void()>& task) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  malloc_trim(0);
  const pid_t child = fork();
  if (child == 0) {
    const auto peak_kilobytes = [] {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return static_cast<double>(usage.ru_maxrss);
    };
    const double before = peak_kilobytes();
    task();
    const double bytes = 1024 * (peak_kilobytes() - before);
    _exit(write(ends[1], &bytes, sizeof bytes) == sizeof bytes ? 0 : 1);
  }
  close(ends[1]);
  double bytes = 0;
  if (read(ends[0], &bytes, sizeof bytes) != sizeof bytes) bytes = 0;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return bytes;
}

}  // namespace regrasp
