#include "planner/base/deadline.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace deadline_test {

using std::chrono::seconds;
using Clock = Deadline::Clock;

TEST(Deadline, IsOverWhenItsTimeHasComeAndNeverWithoutOne) {
  Clock::time_point now{};
  const Deadline deadline(now + seconds(10), [&] { return now; });
  EXPECT_FALSE(Deadline().IsOver());
  EXPECT_FALSE(Deadline().left().has_value());
  EXPECT_NO_THROW(deadline.Check());
  now += seconds(9);
  EXPECT_FALSE(deadline.IsOver());
  EXPECT_EQ(deadline.left(), seconds(1));
  now += seconds(1);
  EXPECT_TRUE(deadline.IsOver());
  EXPECT_THROW(deadline.Check(), TimeUp);
}

TEST(Deadline, AShareOfWhatIsLeftGoesByTheSameClock) {
  Clock::time_point now{};
  const Deadline deadline(now + seconds(10), [&] { return now; });
  now += seconds(2);
  const Deadline sooner = deadline.After(0.25);
  EXPECT_EQ(sooner.left(), seconds(2));
  now += seconds(2);
  EXPECT_TRUE(sooner.IsOver());
  EXPECT_FALSE(deadline.IsOver());
  EXPECT_LE(deadline.After(0.5).left(), deadline.left());
  EXPECT_FALSE(Deadline().After(0.5).left().has_value());
}

TEST(Deadline, IsOverTooWhenSomethingElseSaysSo) {
  bool is_over = false;
  const Deadline other = Deadline().OrWhen([&] { return is_over; });
  EXPECT_FALSE(other.IsOver());
  EXPECT_FALSE(other.After(0.1).IsOver());
  is_over = true;
  EXPECT_TRUE(other.IsOver());
  EXPECT_TRUE(other.After(0.1).IsOver());
  // OrWhen does not limit the time.
  EXPECT_FALSE(other.left().has_value());
  EXPECT_FALSE(other.OrWhen([] { return false; }).left().has_value());
  EXPECT_TRUE(other.OrWhen([] { return false; }).IsOver());

  Deadline::Clock::time_point now;
  const Deadline sooner =
      Deadline(now + std::chrono::seconds(1), [&] { return now; }).OrWhen([] { return false; });
  EXPECT_FALSE(sooner.IsOver());
  EXPECT_EQ(sooner.left(), std::chrono::seconds(1));
  now += std::chrono::seconds(1);
  EXPECT_TRUE(sooner.IsOver());
}

TEST(Deadline, BeyondTheClocksRangeThereIsNone) {
  const Clock::time_point begin = Clock::now();
  EXPECT_EQ(DeadlineAfter(begin, 1e300).left(), std::nullopt);
  EXPECT_GT(DeadlineAfter(begin, 1e6).left(), seconds(0));
  EXPECT_TRUE(DeadlineAfter(begin, 0).IsOver());
}

}  // namespace deadline_test
}  // namespace regrasp
