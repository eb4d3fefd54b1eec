#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "report/page/step_plot.h"

namespace regrasp::report {
namespace plot_axis_test {

/// Expect values between the ends, in order, ticks inside the axis and ascending positions.
void ExpectSound(const PlotAxis& axis, const std::vector<double>& values) {
  EXPECT_LT(axis.lower, axis.upper);
  for (const double value : values) {
    EXPECT_LE(value, axis.upper * (1 + 1e-9));
    EXPECT_GE(axis.Position(value), 0);
    EXPECT_LE(axis.Position(value), 1);
  }
  EXPECT_GE(axis.ticks.size(), 2u);
  EXPECT_LE(axis.ticks.size(), 8u);
  for (const PlotTick& tick : axis.ticks) {
    EXPECT_GE(tick.value, axis.lower - 1e-9 * std::abs(axis.lower));
    EXPECT_LE(tick.value, axis.upper * (1 + 1e-9));
    EXPECT_FALSE(tick.label.empty());
  }
}

TEST(PlotAxisTest, LinearAxesHoldZeroAndAllValues) {
  const std::vector<std::vector<double>> cases = {{12.4, 3}, {-2, 14.7},   {0},      {},
                                                  {0.3},     {1e-7, 2e-7}, {-5, -1}, {89.999}};
  for (const std::vector<double>& values : cases) {
    const PlotAxis axis = MakeLinearAxis(values);
    ExpectSound(axis, values);
    EXPECT_LE(axis.lower, 0);
    EXPECT_GE(axis.upper, 0);
  }
  EXPECT_EQ(MakeLinearAxis({12.4}).upper, 15);
  EXPECT_EQ(MakeLinearAxis({-2, 14.7}).lower, -5);
}

TEST(PlotAxisTest, LogAxesHoldWholeDecadesAroundThePositiveValues) {
  const PlotAxis axis = MakeLogAxis({3e-9, 6e-5, 0, -1});
  ExpectSound(axis, {3e-9, 6e-5, 0, -1});
  EXPECT_NEAR(std::log10(axis.lower), -9, 1e-9);
  EXPECT_NEAR(std::log10(axis.upper), -4, 1e-9);
  EXPECT_NEAR(axis.Position(1e-6), 0.6, 1e-9);
  EXPECT_EQ(axis.Position(0), 0);
  EXPECT_EQ(axis.Position(1), 1);
  EXPECT_EQ(axis.ticks.front().label, "10⁻⁴");
}

TEST(PlotAxisTest, LogAxesNeverSpanMoreDecadesThanCanBeRead) {
  const PlotAxis axis = MakeLogAxis({1e-300, 1e-3});
  ExpectSound(axis, {1e-300, 1e-3});
  EXPECT_NEAR(std::log10(axis.upper / axis.lower), kMostDecades, 1e-6);
  for (const std::vector<double>& values : {std::vector<double>{}, {0}, {1}, {1e-6}}) {
    ExpectSound(MakeLogAxis(values), values);
  }
}

TEST(PlotAxisTest, ValuesThatAreNotFiniteAreRefused) {
  for (const double value : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(static_cast<void>(MakeLinearAxis({1, value})), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(MakeLogAxis({1, value})), std::invalid_argument);
  }
}

TEST(PlotAxisTest, StepsAreRoundAndNoSmallerThanAsked) {
  EXPECT_DOUBLE_EQ(RoundStep(1), 1);
  EXPECT_DOUBLE_EQ(RoundStep(1.01), 2);
  EXPECT_DOUBLE_EQ(RoundStep(0.3), 0.5);
  EXPECT_DOUBLE_EQ(RoundStep(51), 100);
  EXPECT_EQ(FormatPowerOfTen(-12), "10⁻¹²");
  EXPECT_EQ(FormatPowerOfTen(0), "10⁰");
}

}  // namespace plot_axis_test
}  // namespace regrasp::report
