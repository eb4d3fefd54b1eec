// How much of a program's processor time is inside mj_step. The program is the one that is shipped:
// this library is loaded before MuJoCo's (LD_PRELOAD) and times every call on its way. Each process
// that ends, children too, adds a line to the file that REGRASP_STEP_CLOCK names:
//
//     seconds inside mj_step, seconds of the process, calls
//
// What the clock itself takes is measured at the end and left out of both. It is the one that is
// read without a call of the kernel: with the clock of the thread's own processor time, which needs
// one, what runs between steps was slower by a tenth, its caches and predictions lost. A call in
// which the process had to wait for a processor counts as the mean of the others. A process is
// taken to step in one thread.

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

/// Steps of a hand's fingertips and an object take some 20 µs; a process that waits for a processor
/// does so for milliseconds.
constexpr double kWaited_s = 5e-4;

double inside_s = 0;  ///< of the calls that did not wait
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
  // The clock is read twice a call; about one reading of the two falls inside.
  const double reading_s = SecondsOfOneReading() * static_cast<double>(calls);
  std::array<char, 200> line;
  const int size = std::snprintf(line.data(), line.size(), "%.6f %.6f %lld\n", inside - reading_s,
                                 all_s - 2 * reading_s, static_cast<long long>(calls));
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0 || write(file, line.data(), size) != size) std::perror(path);
  close(file);
}

/// A child does not count what its parent did.
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

// How children of a file of lines end.
void _exit(int code) {
  WriteLine();
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}
}
