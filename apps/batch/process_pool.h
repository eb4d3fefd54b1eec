#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace regrasp::apps {

/// Result of a child process of a pool.
struct ChildExit {
  enum class Kind {
    kExited,
    kSignalled,
    kTimedOut,  ///< killed at the time limit
  };
  Kind kind = Kind::kExited;
  int code = 0;        ///< exit code, or the signal that ended the process
  std::string output;  ///< standard output, at most `most_output` bytes
  std::string errors;  ///< standard error, at most kLongestText bytes
  double seconds = 0;  ///< wall-clock time, s
};

/// Default maximum of the recorded bytes of a stream. Further output is read and discarded, so that
/// the child is not blocked.
inline constexpr std::size_t kLongestText = std::size_t{1} << 16;

struct PoolOptions {
  using Clock = std::chrono::steady_clock;
  int jobs = 1;  ///< maximum number of concurrent children, ≥ 1
  /// Wall-clock time limit per child. Time in which this process was stopped does not count.
  std::optional<std::chrono::duration<double>> time_limit;
  std::function<Clock::time_point()> now = Clock::now;
  std::size_t most_output = kLongestText;  ///< recorded bytes of a child's standard output
};

/// Call `work(0)` … `work(count − 1)`, each in its own forked child process.
/// The children start in this order, at most `options.jobs` at a time. `on_exit` is called in this
/// process when a child ends.
///
/// A crash, an endless loop or exhausted memory affects only the child. Its exit code is the return
/// value of `work`; if an exception leaves `work`, the child aborts. Children have no standard
/// input, leave no core file, and run no destructor or exit handler of this process. They die with
/// this process, however it dies.
///
/// On SIGINT, SIGTERM and SIGHUP the function stops all children and returns.
/// @returns the signal that stopped it, which the caller must raise again; 0 if all children ended.
/// @throws EnvironmentError  if a process or pipe cannot be created; no child remains then.
[[nodiscard]] int RunInChildren(int count, const PoolOptions& options,
                                const std::function<int(int)>& work,
                                const std::function<void(int, ChildExit)>& on_exit);

/// Run tasks that become known over time. `next` is called in this process whenever a child may
/// start, and again after each `on_exit` if it returned none.
/// @param next  function that returns the number of a task; nullopt: none at this time, or none at
///     all if no child is running.
[[nodiscard]] int RunInChildren(const std::function<std::optional<int>()>& next,
                                const PoolOptions& options, const std::function<int(int)>& work,
                                const std::function<void(int, ChildExit)>& on_exit);

}  // namespace regrasp::apps
