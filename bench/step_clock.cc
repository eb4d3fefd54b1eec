// Interposer that measures the share of a program's processor time inside mj_step.
// The program is the shipped one: this library is loaded before MuJoCo's (LD_PRELOAD) and times
// every call. Each process that ends, including children, appends a line to the file named by
// REGRASP_STEP_CLOCK:
//
//     seconds inside mj_step, seconds of the process, calls
//
// The cost of the clock is measured at the end and subtracted from both. The clock is one that
// needs no system call. The processor-time clock of the thread needs one, and slowed the code
// between steps by 10 % through lost caches and branch predictions. A call during which the process
// waited for a processor counts as the mean of the other calls. A process is assumed to step in one
// thread.

#include <dlfcn.h>
#include <fcntl.h>
#include <mujoco/mujoco.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

double Seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Threshold of waiting, s: a step of a hand's fingertips and an object takes about 20 µs, a wait
/// for a processor takes milliseconds.
constexpr double kWaited_s = 5e-4;

double inside_s = 0;  ///< time of the calls that did not wait, s
std::int64_t calls = 0;
std::int64_t waited = 0;

double SecondsOfOneReading() {
  constexpr int kReadings = 20'000;
  const double begin = Seconds(CLOCK_MONOTONIC);
  for (int i = 0; i < kReadings; ++i) Seconds(CLOCK_MONOTONIC);
  return (Seconds(CLOCK_MONOTONIC) - begin) / kReadings;
}

void WriteLine() {
  const char* path = std::getenv("REGRASP_STEP_CLOCK");
  if (path == nullptr) return;
  const double all_s = Seconds(CLOCK_PROCESS_CPUTIME_ID);
  const auto counted = static_cast<double>(calls - waited);
  const double inside = counted > 0 ? inside_s * static_cast<double>(calls) / counted : 0;
  // The clock is read twice per call; about one of the two readings falls inside.
  const double reading_s = SecondsOfOneReading() * static_cast<double>(calls);
  std::array<char, 200> line;
  const int size = std::snprintf(line.data(), line.size(), "%.6f %.6f %lld\n", inside - reading_s,
                                 all_s - 2 * reading_s, static_cast<long long>(calls));
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0 || write(file, line.data(), size) != size) std::perror(path);
  close(file);
}

/// Reset the counters: a child does not count the calls of its parent.
void Forget() {
  inside_s = 0;
  calls = waited = 0;
}

struct Process {
  Process() { pthread_atfork(nullptr, nullptr, Forget); }
  ~Process() { WriteLine(); }
} process;

}  // namespace

extern "C" {

void mj_step(const mjModel* model, mjData* data) {
  static const auto step = reinterpret_cast<decltype(&mj_step)>(dlsym(RTLD_NEXT, "mj_step"));
  const double begin = Seconds(CLOCK_MONOTONIC);
  step(model, data);
  const double took_s = Seconds(CLOCK_MONOTONIC) - begin;
  ++calls;
  if (took_s > kWaited_s) {
    ++waited;
  } else {
    inside_s += took_s;
  }
}

// Children of a batch over a JSON Lines file end by _exit.
void _exit(int code) {
  WriteLine();
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}
}
