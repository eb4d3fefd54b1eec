#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace regrasp {

/// Stopwatch for wall time, with laps.
class Stopwatch {
 public:
  /// Return the seconds since the previous lap, or since construction.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Error: a computation has reached its deadline.
class TimeUp : public std::runtime_error {
 public:
  explicit TimeUp(const std::string& message = "time limit reached")
      : std::runtime_error(message) {}
};

/// Deadline of a computation; without a time it never passes.
/// A check takes about 30 ns. Long computations check at least once per millisecond.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  Deadline() = default;
  /// @param at  time of the deadline.
  /// @param now  clock of the deadline.
  Deadline(Clock::time_point at, std::function<Clock::time_point()> now = Clock::now)
      : at_(at), now_(std::move(now)) {}

  [[nodiscard]] bool IsOver() const { return (is_over_ && is_over_()) || (at_ && now_() >= *at_); }
  /// Check the deadline.
  /// @throws TimeUp  if it has passed.
  void Check() const {
    if (IsOver()) throw TimeUp();
  }
  /// Return an earlier deadline, after a share of the remaining time.
  [[nodiscard]] Deadline After(double share) const {
    if (!at_) return *this;
    return In(std::chrono::duration_cast<Clock::duration>(share * (*at_ - now_())));
  }
  /// Return a deadline that passes with this one or as soon as `is_over` returns true.
  /// `is_over` must not return false afterwards. The remaining time does not depend on it.
  [[nodiscard]] Deadline OrWhen(std::function<bool()> is_over) const {
    Deadline either = *this;
    either.is_over_ = [first = is_over_, second = std::move(is_over)] {
      return (first && first()) || second();
    };
    return either;
  }
  /// Return a deadline of the same clock at `time` from the present.
  /// It has no time if this deadline has none.
  [[nodiscard]] Deadline In(Clock::duration time) const {
    Deadline other = *this;
    if (at_) other.at_ = now_() + time;
    return other;
  }
  /// Return the remaining time, negative after the deadline; nullopt if it has no time. OrWhen has
  /// no effect.
  [[nodiscard]] std::optional<Clock::duration> left() const {
    return at_ ? std::optional(*at_ - now_()) : std::nullopt;
  }

 private:
  std::optional<Clock::time_point> at_;
  std::function<Clock::time_point()> now_;
  std::function<bool()> is_over_;
};

/// Return a deadline `seconds` after `begin`; without a time if that exceeds the clock's range.
[[nodiscard]] inline Deadline DeadlineAfter(Deadline::Clock::time_point begin, double seconds) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kHalfOfRange = Seconds(Deadline::Clock::duration::max()).count() / 2;
  if (seconds > kHalfOfRange) return {};
  return begin + std::chrono::duration_cast<Deadline::Clock::duration>(Seconds(seconds));
}

}  // namespace regrasp
