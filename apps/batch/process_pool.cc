#include "apps/batch/process_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {

namespace {

using Clock = PoolOptions::Clock;

/// Maximum wait if there is a time limit.
constexpr std::chrono::milliseconds kLongestWait{200};
/// Maximum time that counts between two clock readings. If more has passed, this process was
/// stopped, most likely by the terminal together with its children. Shorter delays count, so that a
/// busy machine does not extend a limit.
constexpr std::chrono::milliseconds kMostCounted = 2 * kLongestWait;

[[noreturn]] void FailWith(const std::string& what) {
  throw EnvironmentError(what + ": " + std::strerror(errno));
}

/// Converts signals to readable events during its lifetime: ended children, and stop signals that
/// are not ignored.
class SignalEvents {
 public:
  SignalEvents() : events_(-1) {
    sigset_t waited;
    sigemptyset(&waited);
    sigaddset(&waited, SIGCHLD);
    for (const int stop : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction action {};
      sigaction(stop, nullptr, &action);
      if (action.sa_handler != SIG_IGN) sigaddset(&waited, stop);
    }
    sigprocmask(SIG_BLOCK, &waited, &before_);
    // If the parent set SIGCHLD to be ignored, children would end without an exit code.
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &usual, &child_action_);
    events_ = Descriptor(signalfd(-1, &waited, SFD_CLOEXEC | SFD_NONBLOCK));
    if (events_.get() >= 0) return;
    const int error = errno;
    Restore();
    errno = error;
    FailWith("child processes: signal descriptor cannot be created");
  }
  ~SignalEvents() { Restore(); }
  SignalEvents(const SignalEvents&) = delete;
  SignalEvents& operator=(const SignalEvents&) = delete;

  [[nodiscard]] int descriptor() const { return events_.get(); }
  void Restore() const {
    sigaction(SIGCHLD, &child_action_, nullptr);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  /// Discard events of ended children. @returns the stop signal, 0 if there is none.
  [[nodiscard]] int TakeStop() const {
    int stop = 0;
    signalfd_siginfo info;
    while (read(events_.get(), &info, sizeof info) == sizeof info) {
      if (info.ssi_signo != SIGCHLD) stop = static_cast<int>(info.ssi_signo);
    }
    return stop;
  }

 private:
  sigset_t before_;
  struct sigaction child_action_;
  Descriptor events_;
};

/// Pipe of one standard stream of a child.
class Stream {
 public:
  Stream();
  [[nodiscard]] int in() const { return in_.get(); }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Replace a standard stream; called in the child.
  void Replace(int standard) const { dup2(out_.get(), standard); }
  /// Close the write end; called in the parent after the fork.
  void CloseOut() { out_ = Descriptor(-1); }
  /// Read the available data and keep at most `most` bytes in total.
  void Drain(std::size_t most);

 private:
  Descriptor in_, out_;
  std::string text_;
};

struct Child {
  int index;
  pid_t process;
  Stream output, errors;
  Clock::time_point begin;
  Clock::duration left;  ///< remaining time until the time limit
  bool timed_out = false;
};

class Pool {
 public:
  Pool(const PoolOptions& options, const std::function<int(int)>& work,
       const std::function<void(int, ChildExit)>& on_exit)
      : options_(options), work_(work), on_exit_(on_exit), last_check_(options.now()) {}
  ~Pool() { KillAll(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// @returns the signal that stopped it, 0 if all tasks were run.
  int Run(const std::function<std::optional<int>()>& next) {
    while (true) {
      while (static_cast<int>(children_.size()) < options_.jobs) {
        const std::optional<int> task = next();
        if (!task) break;
        Start(*task);
      }
      if (children_.empty()) return 0;
      Wait();
      if (const int stop = signals_.TakeStop(); stop != 0) return stop;
      CountTime();
      KillLate();
      Reap();
    }
  }

 private:
  void Start(int index);
  [[noreturn]] void RunChild(int index, pid_t parent, const Stream& output, const Stream& errors);
  void DrainAll(Child& child) const;
  void Wait();
  void CountTime();
  void KillLate();
  void Reap();
  void KillAll();

  const PoolOptions& options_;
  const std::function<int(int)>& work_;
  const std::function<void(int, ChildExit)>& on_exit_;
  SignalEvents signals_;
  Clock::time_point last_check_;
  std::vector<Child> children_;
};

Stream::Stream() : in_(-1), out_(-1) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) FailWith("child processes: pipe cannot be created");
  in_ = Descriptor(ends[0]);
  out_ = Descriptor(ends[1]);
  fcntl(in(), F_SETFL, O_NONBLOCK);
}

void Stream::Drain(std::size_t most) {
  std::array<char, 1 << 12> piece;
  while (in() >= 0) {
    const ssize_t count = read(in(), piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;
    if (count == 0) {
      in_ = Descriptor(-1);
      return;
    }
    const std::size_t left = most - text_.size();
    text_.append(piece.data(), std::min(left, static_cast<std::size_t>(count)));
  }
}

void Pool::DrainAll(Child& child) const {
  child.output.Drain(options_.most_output);
  child.errors.Drain(kLongestText);
}

void Pool::Start(int index) {
  Stream output, errors;
  // Flush first: buffered text would be written twice.
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) FailWith("child process cannot be started");
  if (process == 0) RunChild(index, parent, output, errors);
  output.CloseOut();
  errors.CloseOut();
  CountTime();  // earlier time does not count for this child
  const auto limit = options_.time_limit.value_or(std::chrono::duration<double>::zero());
  children_.push_back({index, process, std::move(output), std::move(errors), last_check_,
                       std::chrono::duration_cast<Clock::duration>(limit)});
}

void Pool::RunChild(int index, pid_t parent, const Stream& output, const Stream& errors) {
  signals_.Restore();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // the parent died before prctl took effect
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDIN_FILENO);
  output.Replace(STDOUT_FILENO);
  errors.Replace(STDERR_FILENO);
  int code = 0;
  // noexcept, because the handlers of the code before the fork must not catch exceptions of the
  // child.
  [&]() noexcept { code = work_(index); }();
  std::cout.flush();
  std::cerr.flush();
  // Exit handlers and buffers belong to the parent.
  _exit(code);
}

void Pool::Wait() {
  std::vector<pollfd> waited = {{signals_.descriptor(), POLLIN, 0}};
  Clock::duration longest = kLongestWait;
  for (const Child& child : children_) {
    // A closed pipe is always ready, so the end of its child is then awaited by signal.
    for (const Stream* stream : {&child.output, &child.errors}) {
      if (stream->in() >= 0) waited.push_back({stream->in(), POLLIN, 0});
    }
    if (!child.timed_out) longest = std::min(longest, child.left);
  }
  int milliseconds = -1;
  if (options_.time_limit) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(longest);
    milliseconds = std::max(0, static_cast<int>(left.count()));
  }
  poll(waited.data(), waited.size(), milliseconds);
  for (Child& child : children_) DrainAll(child);
}

void Pool::CountTime() {
  const Clock::time_point now = options_.now();
  const auto passed = std::min<Clock::duration>(now - last_check_, kMostCounted);
  last_check_ = now;
  for (Child& child : children_) child.left -= passed;
}

void Pool::KillLate() {
  if (!options_.time_limit) return;
  for (Child& child : children_) {
    if (child.timed_out || child.left > Clock::duration::zero()) continue;
    child.timed_out = true;
    kill(child.process, SIGKILL);
  }
}

void Pool::Reap() {
  for (std::size_t i = 0; i < children_.size();) {
    int status = 0;
    if (waitpid(children_[i].process, &status, WNOHANG) <= 0) {
      ++i;
      continue;
    }
    Child child = std::move(children_[i]);
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(i));
    DrainAll(child);
    ChildExit exit;
    exit.kind = WIFEXITED(status) ? ChildExit::Kind::kExited : ChildExit::Kind::kSignalled;
    exit.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
    // A child that ended by itself at the last instant did not time out.
    if (child.timed_out && exit.kind == ChildExit::Kind::kSignalled) {
      exit.kind = ChildExit::Kind::kTimedOut;
    }
    exit.output = child.output.text();
    exit.errors = child.errors.text();
    exit.seconds = std::chrono::duration<double>(last_check_ - child.begin).count();
    on_exit_(child.index, std::move(exit));
  }
}

void Pool::KillAll() {
  for (const Child& child : children_) kill(child.process, SIGKILL);
  for (const Child& child : children_) {
    while (waitpid(child.process, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

}  // namespace

int RunInChildren(int count, const PoolOptions& options, const std::function<int(int)>& work,
                  const std::function<void(int, ChildExit)>& on_exit) {
  int index = 0;
  const auto next = [&]() -> std::optional<int> {
    if (index == count) return std::nullopt;
    return index++;
  };
  return RunInChildren(next, options, work, on_exit);
}

int RunInChildren(const std::function<std::optional<int>()>& next, const PoolOptions& options,
                  const std::function<int(int)>& work,
                  const std::function<void(int, ChildExit)>& on_exit) {
  return Pool(options, work, on_exit).Run(next);
}

}  // namespace regrasp::apps
