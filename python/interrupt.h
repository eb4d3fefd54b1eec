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

/// Interrupts work that runs without the interpreter's lock, on Ctrl-C or by a Python exception.
///
/// Python handles a signal only when it is polled. Polling happens when the work checks its
/// deadline, at most every kInterval. If the signal handler or the progress function throws, the
/// exception is stored and the deadline is over. The caller throws it after the work has returned.
class Interrupt {
 public:
  /// @param limit_s   time limit from now, s; nullopt: none.
  /// @param progress  function that is called with a line of text; None: not called.
  Interrupt(std::optional<double> limit_s, pybind11::object progress);
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Return a deadline and a progress function, both valid only during the lifetime of this object.
  [[nodiscard]] Deadline deadline();
  [[nodiscard]] std::function<void(std::string_view)> progress();

  /// Poll Python immediately.
  void Poll();

  /// Run work in its own thread, which may start further threads, while this thread polls Python.
  /// Signals are only handled in the interpreter's first thread. Progress messages may come from
  /// any of the threads.
  template <typename Work>
  auto Run(Work work) {
    auto result = std::async(std::launch::async, std::move(work));
    while (result.wait_for(kInterval) != std::future_status::ready) Poll();
    return result.get();
  }
  [[nodiscard]] bool raised() const { return raised_; }
  /// @pre The interpreter's lock is held.
  /// @throws pybind11::error_already_set  if the signal handler or the progress function has
  ///     thrown.
  void ThrowIfRaised();

 private:
  /// Approximate delay from Ctrl-C to the end of the work.
  /// The interpreter's lock is taken at this interval.
  static constexpr std::chrono::milliseconds kInterval{50};

  /// Poll Python if the interval has passed.
  bool HasRaised();
  void Ask(const std::function<void()>& call);

  Deadline limit_;
  pybind11::object progress_;
  std::atomic<Deadline::Clock::time_point> next_;
  std::atomic<bool> raised_ = false;
  std::optional<pybind11::error_already_set> error_;  ///< protected by the interpreter's lock
};

}  // namespace regrasp::python
