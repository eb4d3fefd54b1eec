#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace regrasp {

/// Wall time, lap by lap.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since the watch was made.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Thrown by work that comes to its deadline.
class TimeUp : public std::runtime_error {
 public:
  explicit TimeUp(const std::string& message = "the time was up") : std::runtime_error(message) {}
};

/// When work makes an end; without a time, never. A look at it takes some 30 nanoseconds: long work
/// looks every millisecond or more often.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  Deadline() = default;
  /// @param now  the clock that it goes by.
  Deadline(Clock::time_point at, std::function<Clock::time_point()> now = Clock::now)
      : at_(at), now_(std::move(now)) {}

  [[nodiscard]] bool IsOver() const { return (is_over_ && is_over_()) || (at_ && now_() >= *at_); }
  /// @throws TimeUp  it is over.
  void Check() const {
    if (IsOver()) throw TimeUp();
  }
  /// An earlier one, after a share of what is left.
  [[nodiscard]] Deadline After(double share) const {
    if (!at_) return *this;
    return In(std::chrono::duration_cast<Clock::duration>(share * (*at_ - now_())));
  }
  /// Over when this one is, and from when `is_over` says so, which is for good. How much is left
  /// does not depend on that.
  [[nodiscard]] Deadline OrWhen(std::function<bool()> is_over) const {
    Deadline either = *this;
    either.is_over_ = [first = is_over_, second = std::move(is_over)] {
      return (first && first()) || second();
    };
    return either;
  }
  /// Another one by the same clock, after so long from now; without a time as this one is.
  [[nodiscard]] Deadline In(Clock::duration time) const {
    Deadline other = *this;
    if (at_) other.at_ = now_() + time;
    return other;
  }
  /// What is left until then, negative afterwards; nullopt: no end, but for what OrWhen says.
  [[nodiscard]] std::optional<Clock::duration> left() const {
    return at_ ? std::optional(*at_ - now_()) : std::nullopt;
  }

 private:
  std::optional<Clock::time_point> at_;
  std::function<Clock::time_point()> now_;
  std::function<bool()> is_over_;
};

/// So many seconds after `begin`; never where that is beyond the clock's range.
[[nodiscard]] inline Deadline DeadlineAfter(Deadline::Clock::time_point begin, double seconds) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kHalfOfRange = Seconds(Deadline::Clock::duration::max()).count() / 2;
  if (seconds > kHalfOfRange) return {};
  return begin + std::chrono::duration_cast<Deadline::Clock::duration>(Seconds(seconds));
}

}  // namespace regrasp
