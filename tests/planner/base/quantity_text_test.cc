#include <gtest/gtest.h>

#include <utility>

#include "planner/base/number.h"

namespace regrasp {
namespace quantity_text_test {

TEST(QuantityText, ALengthTakesTheUnitThatSuits) {
  EXPECT_EQ(FormatLength(4100), "4.1 km");
  EXPECT_EQ(FormatLength(2), "2 m");
  EXPECT_EQ(FormatLength(0.5), "50 cm");
  EXPECT_EQ(FormatLength(0.01), "1 cm");
  EXPECT_EQ(FormatLength(0.005), "5 mm");
  EXPECT_EQ(FormatLength(5e-4), "500 µm");
  EXPECT_EQ(FormatLength(2e-6), "2 µm");
  EXPECT_EQ(FormatLength(5e-9), "5 nm");
  EXPECT_EQ(FormatLength(5e-12), "0.005 nm");
  EXPECT_EQ(FormatLength(0), "0 nm");
  EXPECT_EQ(FormatLength(0.00412345), "4.12 mm");
  EXPECT_EQ(FormatLength(0.00412345, 2), "4.1 mm");
  EXPECT_EQ(FormatLength(5e-4, 2), "500 µm");
}

TEST(QuantityText, WhatRoundsUpToAUnitIsOneOfIt) {
  int checked = 0;
  for (const auto& [size, text] :
       {std::pair{1e3, "1 km"}, {1.0, "1 m"}, {1e-2, "1 cm"}, {1e-3, "1 mm"}, {1e-6, "1 µm"}}) {
    EXPECT_EQ(FormatLength(0.9997 * size), text);
    EXPECT_EQ(FormatLength(size), text);
    EXPECT_EQ(FormatLength(1.0003 * size), text);
    EXPECT_NE(FormatLength(0.999 * size), text);
    ++checked;
  }
  EXPECT_EQ(checked, 5);
}

TEST(QuantityText, APlainNumberHasNoPowerOfTen) {
  EXPECT_EQ(FormatPlain(1.66, 2), "1.7");
  EXPECT_EQ(FormatPlain(99.4, 2), "99");
  EXPECT_EQ(FormatPlain(166, 2), "170");
  EXPECT_EQ(FormatPlain(-123456, 3), "-123000");
  EXPECT_EQ(FormatPlain(99.9, 2), "100");
  EXPECT_EQ(FormatPlain(2.16e8, 3), "2.16e+08");
  EXPECT_EQ(FormatPlain(5.73e-5, 3), "0.0000573");
  EXPECT_EQ(FormatPlain(-1.2e-6, 4), "-0.0000012");
  EXPECT_EQ(FormatPlain(2.8868e-4, 4), "0.0002887");
  EXPECT_EQ(FormatPlain(9.99996e-4, 4), "0.001");
}

TEST(QuantityText, OfMassesAndAngles) {
  EXPECT_EQ(FormatMass(1.4), "1.4 kg");
  EXPECT_EQ(FormatMass(0.216), "216 g");
  EXPECT_EQ(FormatMass(2.16e-7), "216 µg");
  EXPECT_EQ(FormatDegrees(12.4), "12.40°");
  EXPECT_EQ(FormatDegrees(-0.126), "-0.13°");
}

}  // namespace quantity_text_test
}  // namespace regrasp
