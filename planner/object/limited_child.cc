#include "planner/object/limited_child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/memory.h"

namespace regrasp::object {

namespace {

constexpr int kExitDone = 0;
constexpr int kExitThrew = 1;
constexpr int kExitNoMemory = 2;

void Limit(int resource, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(resource, &limit);
}

bool WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void RunChild(const std::function<std::string()>& task, const ChildLimits& limits,
                           int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // without a parent, the result is useless
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  if (!kSanitizer && !limits.opens_files) Limit(RLIMIT_NOFILE, 0);  // open descriptors stay usable
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(limits.processor.count()));
  if (!kSanitizer) Limit(RLIMIT_AS, limits.memory_bytes);
  // _exit, because the exit handlers and buffers belong to the parent.
  try {
    _exit(WriteAll(out, task()) ? kExitDone : kExitThrew);
  } catch (const std::bad_alloc&) {
    _exit(kExitNoMemory);
  } catch (const std::exception& error) {
    WriteAll(out, error.what());
    _exit(kExitThrew);
  } catch (...) {
    _exit(kExitThrew);
  }
}

/// Read until the child closes its end. @returns false if the time or size limit is reached.
bool ReadAll(int in, std::chrono::steady_clock::time_point deadline, std::string& bytes) {
  using std::chrono::milliseconds;
  std::array<char, 1 << 16> piece;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left <= milliseconds::zero()) return false;
    pollfd waiting{in, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno != EINTR) return false;
    if (ready <= 0) continue;
    const ssize_t count = read(in, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    if (count == 0) return true;
    bytes.append(piece.data(), static_cast<std::size_t>(count));
    if (bytes.size() > kMaxInputBytes) return false;
  }
}

int WaitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

ChildEnd EndOf(int status) {
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) == kExitDone) return ChildEnd::kDone;
    if (WEXITSTATUS(status) == kExitThrew) return ChildEnd::kThrew;
    return ChildEnd::kCrashed;
  }
  // The soft and hard limit of processor time are equal, so the kernel kills at once.
  const int signal = WTERMSIG(status);
  return signal == SIGXCPU || signal == SIGKILL ? ChildEnd::kTookTooLong : ChildEnd::kCrashed;
}

}  // namespace

ChildResult RunInLimitedChild(const std::function<std::string()>& task, const ChildLimits& limits) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw EnvironmentError(std::string("pipe to a child process cannot be created: ") +
                           std::strerror(errno));
  }
  const auto deadline = std::chrono::steady_clock::now() + limits.wall;
  const pid_t child = fork();
  if (child < 0) {
    const std::string why = std::strerror(errno);
    close(ends[0]);
    close(ends[1]);
    throw EnvironmentError("child process cannot be started: " + why);
  }
  if (child == 0) RunChild(task, limits, ends[1]);
  close(ends[1]);
  ChildResult result;
  const bool complete = ReadAll(ends[0], deadline, result.bytes);
  if (!complete) kill(child, SIGKILL);
  close(ends[0]);
  result.end = EndOf(WaitFor(child));
  if (!complete) result.end = ChildEnd::kTookTooLong;
  return result;
}

}  // namespace regrasp::object
