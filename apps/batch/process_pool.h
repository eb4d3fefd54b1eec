#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace regrasp::apps {

/// How a child process of a pool ended.
struct ChildExit {
  enum class Kind {
    kExited,
    kSignalled,
    kTimedOut,  ///< it was killed at the time limit
  };
  Kind kind = Kind::kExited;
  int code = 0;        ///< exit code, or the signal that ended it
  std::string output;  ///< what it wrote on standard output, at most `most_output` bytes
  std::string errors;  ///< on standard error, at most kLongestText bytes
  double seconds = 0;  ///< that it took, by the clock
};

/// Of a stream where the options ask for no other limit. More is read, so that the child can go on,
/// and thrown away.
inline constexpr std::size_t kLongestText = std::size_t{1} << 16;

struct PoolOptions {
  using Clock = std::chrono::steady_clock;
  int jobs = 1;  ///< children at a time, ≥ 1
  /// Of each child, by the clock; time in which this process was stopped does not count.
  std::optional<std::chrono::duration<double>> time_limit;
  std::function<Clock::time_point()> now = Clock::now;
  std::size_t most_output = kLongestText;  ///< bytes of a child's standard output that are kept
};

/// Calls `work(0)` … `work(count − 1)`, each in a forked child of its own, in this order and at
/// most `options.jobs` at a time, and `on_exit` in this process as each of them ends.
///
/// What a child does to itself (a crash, an endless loop, memory that runs out) ends with it. A
/// child's exit code is what `work` returns; where an exception leaves `work`, it aborts. Children
/// read nothing from standard input, leave no core file and run no destructor or exit handler of
/// this process. They die when this process does, however it dies.
///
/// SIGINT, SIGTERM and SIGHUP stop all children, and then this function.
/// @returns the signal that stopped it, which the caller owes its usual effect; 0 where all ended.
/// @throws EnvironmentError  no process or pipe can be made; no child is left then.
[[nodiscard]] int RunInChildren(int count, const PoolOptions& options,
                                const std::function<int(int)>& work,
                                const std::function<void(int, ChildExit)>& on_exit);

/// The same for tasks that become known as time goes on: `next` is asked, in this process, whenever
/// a child may start, and again after each `on_exit` where it had none.
/// @param next  the number of a task; nullopt: none now, and none at all if no child is left.
[[nodiscard]] int RunInChildren(const std::function<std::optional<int>()>& next,
                                const PoolOptions& options, const std::function<int(int)>& work,
                                const std::function<void(int, ChildExit)>& on_exit);

}  // namespace regrasp::apps
