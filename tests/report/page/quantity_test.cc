#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/page/step_table.h"

namespace regrasp::report {
namespace quantity_test {

TEST(QuantityTest, NumbersHaveThreeDigits) {
  EXPECT_EQ(NumberText(0), "0");
  EXPECT_EQ(NumberText(1), "1");
  EXPECT_EQ(NumberText(0.36397), "0.364");
  EXPECT_EQ(NumberText(-2.5), "-2.5");
  EXPECT_EQ(NumberText(2118.96), "2119");
  EXPECT_EQ(NumberText(100), "100");
}

TEST(QuantityTest, VerySmallAndVeryLargeNumbersHaveAPowerOfTen) {
  EXPECT_EQ(NumberText(4.7e-6), "4.7\u00a0×\u00a010⁻⁶");
  EXPECT_EQ(NumberText(-3e12), "-3\u00a0×\u00a010¹²");
}

TEST(QuantityTest, LengthsHaveTheUnitThatSuitsThem) {
  EXPECT_EQ(LengthText(1.25), "1.25\u00a0m");
  EXPECT_EQ(LengthText(0.10392), "10.4\u00a0cm");
  EXPECT_EQ(LengthText(1.0392e-4), "104\u00a0µm");
  EXPECT_EQ(LengthText(7.8e-9), "7.8\u00a0nm");
  EXPECT_EQ(LengthText(3.4e-10), "0.34\u00a0nm");
  EXPECT_EQ(LengthText(1e-11), "0");
}

TEST(QuantityTest, WhatIsNotFiniteIsADash) {
  EXPECT_EQ(NumberText(std::nan("")), "–");
  EXPECT_EQ(LengthText(std::numeric_limits<double>::infinity()), "–");
}

}  // namespace quantity_test
}  // namespace regrasp::report
