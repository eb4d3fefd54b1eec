#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace regrasp {

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

  [[nodiscard]] bool IsOver() const { return at_ && now_() >= *at_; }
  /// @throws TimeUp  it is over.
  void Check() const {
    if (IsOver()) throw TimeUp();
  }
  /// An earlier one, after a share of what is left.
  [[nodiscard]] Deadline After(double share) const {
    if (!at_) return {};
    const Clock::time_point now = now_();
    return {now + std::chrono::duration_cast<Clock::duration>(share * (*at_ - now)), now_};
  }
  /// Over when this one is, and from when `is_over` says so, which is for good.
  [[nodiscard]] Deadline OrWhen(std::function<bool()> is_over) const {
    // Far from the clock's last instant, as deadlines are added to.
    constexpr std::chrono::hours kNever(24 * 365 * 100);
    return {at_.value_or(Clock::now() + kNever),
            [now = at_ ? now_ : Clock::now, is_over = std::move(is_over)] {
              return is_over() ? Clock::time_point::max() : now();
            }};
  }
  /// Another one by the same clock, after so long from now.
  [[nodiscard]] Deadline In(Clock::duration time) const {
    return at_ ? Deadline(now_() + time, now_) : Deadline();
  }
  /// What is left until then, negative afterwards; nullopt: no end.
  [[nodiscard]] std::optional<Clock::duration> left() const {
    return at_ ? std::optional(*at_ - now_()) : std::nullopt;
  }

 private:
  std::optional<Clock::time_point> at_;
  std::function<Clock::time_point()> now_;
};

/// So many seconds after `begin`; never where that is beyond the clock's range.
[[nodiscard]] inline Deadline DeadlineAfter(Deadline::Clock::time_point begin, double seconds) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kHalfOfRange = Seconds(Deadline::Clock::duration::max()).count() / 2;
  if (seconds > kHalfOfRange) return {};
  return begin + std::chrono::duration_cast<Deadline::Clock::duration>(Seconds(seconds));
}

}  // namespace regrasp
