#include "planner/base/limit_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"

namespace regrasp {
namespace limit_text_test {

/// Return the number at the beginning of a text.
double NumberIn(const std::string& text) {
  const auto number = ParseDouble(text.substr(0, text.find_first_not_of("0123456789.e-")));
  return number.value_or(std::nan(""));
}

TEST(LimitTextTest, WhatExceedsItsLimitIsNeverShownEqualToIt) {
  int checked = 0;
  for (const double limit : {1e-3, 0.0123456, 5.0, 2.5e-7, 0.7}) {
    for (double more = 1; more > 1e-13; more /= 10) {
      for (const double value : {limit * (1 + more), limit * (1 - more / 2)}) {
        const LimitText plain = FormatWithLimit(value, limit);
        EXPECT_EQ(NumberIn(plain.value) > NumberIn(plain.limit), value > limit);
        const LimitText length = FormatLengthWithLimit(value, limit);
        EXPECT_NE(length.value, length.limit);
        const LimitText degrees = FormatDegreesWithLimit(value, limit);
        EXPECT_NE(degrees.value, degrees.limit);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(LimitTextTest, UsesNoMoreDigitsThanItTakes) {
  EXPECT_EQ(FormatLengthWithLimit(1.4e-3, 1e-3).value, "1.4 mm");
  EXPECT_EQ(FormatLengthWithLimit(1.4e-3, 1e-3).limit, "1 mm");
  EXPECT_EQ(FormatLengthWithLimit(1.0004e-3, 1e-3).value, "1.0004 mm");
  EXPECT_EQ(FormatDegreesWithLimit(5.0001, 5).value, "5.0001°");
  EXPECT_EQ(FormatDegreesWithLimit(5.0001, 5).limit, "5.0000°");
  EXPECT_EQ(FormatWithLimit(2, 2).value, "2");
}

TEST(LimitTextTest, ARequiredAngleIsRoundedUpSoThatTheNumberShownIsEnough) {
  EXPECT_EQ(FormatRequiredDegrees(5.3201), "5.33");
  EXPECT_EQ(FormatRequiredDegrees(5.3299), "5.33");
  EXPECT_EQ(FormatRequiredDegrees(5.33), "5.33");
  EXPECT_EQ(FormatRequiredDegrees(45 + 6e-8), "45.00") << "a bound that is computed to 6e-8";
  EXPECT_EQ(FormatRequiredDegrees(0), "0.00");
}

TEST(LimitTextTest, RequiredAndAvailableAnglesAreOrderedAsTheyAre) {
  int checked = 0;
  for (const double available : {20.0, 20.004, 20.006, 5.3249}) {
    for (double apart = 1; apart > 1e-9; apart /= 7) {
      for (const double required : {available + apart, available - apart}) {
        const auto [needed, has] = FormatRequiredDegrees(required, available);
        EXPECT_EQ(NumberIn(needed) <= NumberIn(has), required <= available)
            << needed << " of " << has;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 80);
  const auto [needed, has] = FormatRequiredDegrees(5.3201, 5);
  EXPECT_EQ(needed, FormatRequiredDegrees(5.3201));
  EXPECT_EQ(has, "5.00");
}

}  // namespace limit_text_test
}  // namespace regrasp
