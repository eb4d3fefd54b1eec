#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planner/base/random.h"

namespace regrasp {
namespace binomial_test {

TEST(ShareInterval, OfAllOrNoneIsTheClosedForm) {
  // Upper end p for 0 of n: (1 − p)^n = 0.025.
  for (const int n : {1, 10, 100, 1000}) {
    const double end = 1 - std::pow(0.025, 1.0 / n);
    EXPECT_EQ(ComputeShareInterval(0, n, 0.95).lower, 0);
    EXPECT_NEAR(ComputeShareInterval(0, n, 0.95).upper, end, 1e-12);
    EXPECT_NEAR(ComputeShareInterval(n, n, 0.95).lower, 1 - end, 1e-12);
    EXPECT_EQ(ComputeShareInterval(n, n, 0.95).upper, 1);
  }
}

TEST(ShareInterval, LeavesOutTheTailsOfTheBinomialDistribution) {
  // At the lower end 8 or more of 10 occur with probability 0.025, at the upper end 8 or fewer.
  const ShareInterval interval = ComputeShareInterval(8, 10, 0.95);
  const auto chance = [](int k, double p) {
    return std::tgamma(11) / std::tgamma(k + 1) / std::tgamma(11 - k) * std::pow(p, k) *
           std::pow(1 - p, 10 - k);
  };
  double above = 0, below = 1;
  for (const int k : {8, 9, 10}) above += chance(k, interval.lower);
  for (const int k : {9, 10}) below -= chance(k, interval.upper);
  EXPECT_NEAR(above, 0.025, 1e-9);
  EXPECT_NEAR(below, 0.025, 1e-9);
  EXPECT_NEAR(interval.lower, 0.4439, 1e-4);
  EXPECT_NEAR(interval.upper, 0.9748, 1e-4);
}

TEST(ShareInterval, RefusesWhatIsNoShare) {
  EXPECT_THROW((void)ComputeShareInterval(0, 0, 0.95), std::invalid_argument);
  EXPECT_THROW((void)ComputeShareInterval(-1, 5, 0.95), std::invalid_argument);
  EXPECT_THROW((void)ComputeShareInterval(6, 5, 0.95), std::invalid_argument);
  EXPECT_THROW((void)ComputeShareInterval(1, 5, 1), std::invalid_argument);
  EXPECT_THROW((void)ComputeShareInterval(1, 5, std::nan("")), std::invalid_argument);
}

}  // namespace binomial_test
}  // namespace regrasp
