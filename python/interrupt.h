#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string_view>
#include <utility>

#include "planner/base/deadline.h"

namespace regrasp::python {

/// Lets Ctrl-C end work that runs without the interpreter's lock, and passes on what it says.
///
/// Python handles a signal only where it is asked to: whenever the work looks at its deadline we
/// ask, every kInterval at most. What the handler or the progress function throws is
/// kept, the deadline is over from then on, and the caller throws it when the work has come back.
class Interrupt {
 public:
  /// @param limit_s   seconds from now; nullopt: no end.
  /// @param progress  called with a line of text; None: nothing is.
  Interrupt(std::optional<double> limit_s, pybind11::object progress);
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Both for the time in which this object lives.
  [[nodiscard]] Deadline deadline();
  [[nodiscard]] std::function<void(std::string_view)> progress();

  /// Asks Python at once.
  void Poll();

  /// Does work in a thread of its own, which may start others, while this one asks Python: signals
  /// are handled in the interpreter's first thread alone. What says something is any of them.
  template <typename Work>
  auto Run(Work work) {
    auto result = std::async(std::launch::async, std::move(work));
    while (result.wait_for(kInterval) != std::future_status::ready) Poll();
    return result.get();
  }
  [[nodiscard]] bool raised() const { return raised_; }
  /// @pre the interpreter's lock is held.
  /// @throws pybind11::error_already_set  the signal handler or the progress function did.
  void ThrowIfRaised();

 private:
  /// So soon after Ctrl-C work ends, about, and so rarely is the interpreter's lock taken.
  static constexpr std::chrono::milliseconds kInterval{50};

  /// Asks Python if it is time to.
  bool HasRaised();
  void Ask(const std::function<void()>& call);

  Deadline limit_;
  pybind11::object progress_;
  std::atomic<Deadline::Clock::time_point> next_;
  std::atomic<bool> raised_ = false;
  std::optional<pybind11::error_already_set> error_;  ///< under the interpreter's lock
};

}  // namespace regrasp::python
