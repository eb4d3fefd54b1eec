#include "python/binding.h"

#include <algorithm>
#include <string>
#include <utility>

namespace regrasp::python {

namespace py = pybind11;

namespace {

Deadline LimitOf(std::optional<double> limit_s) {
  return limit_s ? DeadlineAfter(Deadline::Clock::now(), *limit_s) : Deadline();
}

}  // namespace

Interrupt::Interrupt(std::optional<double> limit_s, py::object progress)
    : limit_(LimitOf(limit_s)),
      progress_(std::move(progress)),
      next_(Deadline::Clock::now() + kInterval) {}

Deadline Interrupt::deadline() {
  return limit_.OrWhen([this] { return HasRaised(); });
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

bool Interrupt::HasRaised() {
  const auto now = Deadline::Clock::now();
  auto next = next_.load();
  if (now >= next && next_.compare_exchange_strong(next, now + kInterval)) Poll();
  return raised_;
}

void Interrupt::ThrowIfRaised() {
  if (error_) throw std::move(*error_);
}

}  // namespace regrasp::python
