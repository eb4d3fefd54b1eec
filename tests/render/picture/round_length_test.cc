#include "render/picture/round_length.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regrasp::render {
namespace {

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

TEST(FormatLength, TakesTheUnitThatSuits) {
  EXPECT_EQ(FormatLength(4100), "4.1 km");
  EXPECT_EQ(FormatLength(2), "2 m");
  EXPECT_EQ(FormatLength(1), "1 m");
  EXPECT_EQ(FormatLength(0.5), "50 cm");
  EXPECT_EQ(FormatLength(0.01), "1 cm");
  EXPECT_EQ(FormatLength(0.005), "5 mm");
  EXPECT_EQ(FormatLength(0.001), "1 mm");
  EXPECT_EQ(FormatLength(5e-4), "500 µm");
  EXPECT_EQ(FormatLength(2e-6), "2 µm");
  EXPECT_EQ(FormatLength(5e-9), "5 nm");
  EXPECT_EQ(FormatLength(5e-12), "5e-12 m");
  EXPECT_EQ(FormatLength(0.00412345, 3), "4.12 mm");
}

TEST(FormatLength, OfEveryRoundLengthIsARoundNumber) {
  for (double power = 1e-6; power < 1e3; power *= 10) {
    for (const double digit : {1, 2, 5}) {
      const std::string text = FormatLength(RoundLength(digit * power * (1 + 1e-12)));
      EXPECT_TRUE(text[0] == "125"[digit == 1 ? 0 : digit == 2 ? 1 : 2]) << text;
      EXPECT_EQ(text.find('.'), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace regrasp::render
