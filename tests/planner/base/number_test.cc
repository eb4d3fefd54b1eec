#include "planner/base/number.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <random>

#include "planner/base/json.h"

namespace regrasp {
namespace number_test {

TEST(ParseDouble, ReadsDecimalNumbers) {
  EXPECT_EQ(ParseDouble("0"), 0.0);
  EXPECT_EQ(ParseDouble("-1.5"), -1.5);
  EXPECT_EQ(ParseDouble("+1.5"), 1.5);
  EXPECT_EQ(ParseDouble(".5"), 0.5);
  EXPECT_EQ(ParseDouble("5."), 5.0);
  EXPECT_EQ(ParseDouble("1e3"), 1000.0);
  EXPECT_EQ(ParseDouble("1E-3"), 0.001);
  EXPECT_EQ(ParseDouble("0.1"), 0.1);
  EXPECT_TRUE(std::signbit(*ParseDouble("-0")));
}

TEST(ParseDouble, RefusesEverythingElse) {
  int refused = 0;
  for (const std::string_view text :
       {"",      "+",   "-",    ".",        "e5",    "1e",    "1 ",    " 1",     "1,5",
        "1.5.2", "+-1", "-+1",  "++1",      "--1",   "0x10",  "1e999", "-1e999", "nan",
        "NaN",   "inf", "-inf", "infinity", "1_000", "1'000", "١"}) {
    EXPECT_FALSE(ParseDouble(text).has_value()) << text;
    ++refused;
  }
  EXPECT_EQ(refused, 25);
  EXPECT_FALSE(ParseDouble(std::string_view("1\0", 2)).has_value());
}

TEST(FormatDouble, ComesBackAsTheSameBits) {
  std::mt19937_64 random(2);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const auto back = ParseDouble(FormatDouble(value));
    ASSERT_TRUE(back.has_value()) << FormatDouble(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
    ++compared;
  }
  EXPECT_GT(compared, 19000);
}

TEST(FormatFixed, HasTheDecimalsAsked) {
  EXPECT_EQ(FormatFixed(16, 2), "16.00");
  EXPECT_EQ(FormatFixed(4.191e-8, 2), "0.00");
  EXPECT_EQ(FormatFixed(-1.005e3, 1), "-1005.0");
}

TEST(FormatShort, RoundsToTheDigitsAsked) {
  EXPECT_EQ(FormatShort(0.123456), "0.1235");
  EXPECT_EQ(FormatShort(1.0 / 3, 2), "0.33");
  EXPECT_EQ(FormatShort(1234567, 3), "1.23e+06");
  EXPECT_EQ(FormatShort(0), "0");
}

class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Numbers, AreTheSameUnderALocaleWithCommas) {
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;  // if the machine has it
  }
  EXPECT_EQ(ParseDouble("1.5"), 1.5);
  EXPECT_FALSE(ParseDouble("1,5").has_value());
  EXPECT_EQ(FormatDouble(1234.5), "1234.5");
  EXPECT_EQ(FormatShort(1234.5, 5), "1234.5");
  EXPECT_EQ(ParseJson("[1234.5, 1e3]", "t").dump(), "[1234.5,1000.0]");
  EXPECT_EQ(FormatJson(Json(12345678)), "12345678\n");
  EXPECT_EQ(ParseJson(FormatJson(Json(1234.5)), "t").get<double>(), 1234.5);
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
}

TEST(Angle, DegreesAndRadiansAreInverse) {
  EXPECT_DOUBLE_EQ(Radians(180), std::numbers::pi);
  EXPECT_DOUBLE_EQ(Degrees(Radians(20)), 20);
}

}  // namespace number_test

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
