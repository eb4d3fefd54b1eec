#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/deadline.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::python {

/// Object held by Python.
struct PythonObject {
  object::ObjectFile file;
  double scale = 1;  ///< metres per unit of length
  std::string text;  ///< text of the corresponding file; empty if it was read from a file
  std::optional<object::Shells> shells = std::nullopt;  ///< how a file with several was read
};

/// Hand held by Python.
struct PythonHand {
  kinematics::HandFile file;
  std::filesystem::path path;  ///< path from which it was read
};

/// Check that a plan was made for an object. @param name  name of the plan in messages.
/// @throws InputError  if the plan was made for another object or for another scale of it.
void CheckFits(const plan::Plan& plan, const PythonObject& object, const std::string& name);

// Add the functions of one part to the extension module. The Python code above them checks all
// types and shapes, so that they do not.
void BindObjects(pybind11::module_& module);
void BindGrasps(pybind11::module_& module);
void BindHands(pybind11::module_& module);
void BindHandGrasps(pybind11::module_& module);
void BindPlans(pybind11::module_& module);
void BindReports(pybind11::module_& module);
void BindFigures(pybind11::module_& module);

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
