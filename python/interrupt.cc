#include "python/interrupt.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace regrasp::python {

namespace py = pybind11;

namespace {

/// So soon after Ctrl-C work ends, about, and so rarely is the interpreter's lock taken.
constexpr std::chrono::milliseconds kInterval(50);

/// Instead of no end, so that the work looks at its deadline; far from the clock's last instant, as
/// deadlines are added to.
constexpr std::chrono::hours kNever(24 * 365 * 100);

Deadline::Clock::time_point EndOf(std::optional<double> limit_s) {
  const auto now = Deadline::Clock::now();
  const auto left = limit_s ? DeadlineAfter(now, *limit_s).left() : std::nullopt;
  return now + std::min<Deadline::Clock::duration>(left.value_or(kNever), kNever);
}

}  // namespace

Interrupt::Interrupt(std::optional<double> limit_s, py::object progress)
    : end_(EndOf(limit_s)),
      progress_(std::move(progress)),
      next_(Deadline::Clock::now() + kInterval) {}

Deadline Interrupt::deadline() {
  return {end_, [this] { return Now(); }};
}

std::function<void(std::string_view)> Interrupt::progress() {
  return [this](std::string_view text) {
    Ask([&] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(std::string(text));
    });
  };
}

void Interrupt::Poll() {
  Ask([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

void Interrupt::Ask(const std::function<void()>& call) {
  if (raised_) return;
  const py::gil_scoped_acquire lock;
  try {
    call();
  } catch (py::error_already_set& error) {
    if (!error_) error_.emplace(error);
    raised_ = true;
  }
}

Deadline::Clock::time_point Interrupt::Now() {
  const auto now = Deadline::Clock::now();
  auto next = next_.load();
  if (now >= next && next_.compare_exchange_strong(next, now + kInterval)) Poll();
  return raised_ ? Deadline::Clock::time_point::max() : now;
}

void Interrupt::ThrowIfRaised() {
  if (error_) throw std::move(*error_);
}

}  // namespace regrasp::python
