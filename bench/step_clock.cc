// How much of a program's processor time is inside mj_step. The program is the one that is shipped:
// this library is loaded before MuJoCo's (LD_PRELOAD) and times every call on its way. Each process
// that ends, children too, adds a line to the file that REGRASP_STEP_CLOCK names:
//
//     seconds inside mj_step, seconds of the process, calls
//
// What the clock itself takes is measured at the end and left out of both.

#include <dlfcn.h>
#include <fcntl.h>
#include <mujoco/mujoco.h>
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

double inside_s = 0;
std::int64_t calls = 0;

double SecondsOfOneReading() {
  constexpr int kReadings = 20'000;
  const double begin = Seconds(CLOCK_THREAD_CPUTIME_ID);
  for (int i = 0; i < kReadings; ++i) Seconds(CLOCK_THREAD_CPUTIME_ID);
  return (Seconds(CLOCK_THREAD_CPUTIME_ID) - begin) / kReadings;
}

void WriteLine() {
  const char* path = std::getenv("REGRASP_STEP_CLOCK");
  if (path == nullptr) return;
  const double all_s = Seconds(CLOCK_PROCESS_CPUTIME_ID);
  // A call is read twice; about one reading of the two falls inside.
  const double reading_s = SecondsOfOneReading() * static_cast<double>(calls);
  std::array<char, 200> line;
  const int size = std::snprintf(line.data(), line.size(), "%.6f %.6f %lld\n", inside_s - reading_s,
                                 all_s - 2 * reading_s, static_cast<long long>(calls));
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0 || write(file, line.data(), size) != size) std::perror(path);
  close(file);
}

struct AtExit {
  ~AtExit() { WriteLine(); }
} at_exit;

}  // namespace

extern "C" {

void mj_step(const mjModel* model, mjData* data) {
  static const auto step = reinterpret_cast<decltype(&mj_step)>(dlsym(RTLD_NEXT, "mj_step"));
  const double begin = Seconds(CLOCK_THREAD_CPUTIME_ID);
  step(model, data);
  inside_s += Seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
  ++calls;
}

// How children of a file of lines end.
void _exit(int code) {
  WriteLine();
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}
}
