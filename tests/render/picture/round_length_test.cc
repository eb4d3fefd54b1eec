#include <gtest/gtest.h>

#include <cmath>

#include "render/picture/caption.h"

namespace regrasp::render {
namespace round_length_test {

TEST(RoundLength, IsTheLongestOfOneTwoAndFiveThatFits) {
  EXPECT_DOUBLE_EQ(RoundLength(1), 1);
  EXPECT_DOUBLE_EQ(RoundLength(1.99), 1);
  EXPECT_DOUBLE_EQ(RoundLength(2), 2);
  EXPECT_DOUBLE_EQ(RoundLength(4.99), 2);
  EXPECT_DOUBLE_EQ(RoundLength(5), 5);
  EXPECT_DOUBLE_EQ(RoundLength(9.99), 5);
  EXPECT_DOUBLE_EQ(RoundLength(0.0371), 0.02);
  EXPECT_DOUBLE_EQ(RoundLength(7.2e-9), 5e-9);
  EXPECT_DOUBLE_EQ(RoundLength(1234), 1000);
}

TEST(RoundLength, NeverExceedsTheLimitAndIsMoreThanTwoFifthsOfIt) {
  int checked = 0;
  for (double limit = 1e-7; limit < 1e7; limit *= 1.0137) {
    const double length = RoundLength(limit);
    EXPECT_LE(length, limit);
    EXPECT_GT(length, 0.4 * limit);
    const double digit = length / std::pow(10.0, std::floor(std::log10(length * (1 + 1e-9))));
    EXPECT_NEAR((digit - 1) * (digit - 2) * (digit - 5), 0, 1e-9) << limit;
    ++checked;
  }
  EXPECT_GT(checked, 2000);
}

}  // namespace round_length_test
}  // namespace regrasp::render
