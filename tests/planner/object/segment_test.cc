#include "planner/object/segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace regrasp::object {
namespace segment_coverage_test {

/// Tolerance of interval ends: the last place of a parameter times a slope of one.
constexpr double kNear = 1e-12;

TEST(SublevelInterval, OfADistanceToAPointIsAboutIt) {
  const auto from = [](double centre) {
    return [centre](double t) { return std::abs(t - centre); };
  };
  const auto middle = SublevelInterval(from(0.4), 0.1).value();
  EXPECT_NEAR(middle.first, 0.3, kNear);
  EXPECT_NEAR(middle.second, 0.5, kNear);
  const auto at_begin = SublevelInterval(from(0.05), 0.1).value();
  EXPECT_EQ(at_begin.first, 0);
  EXPECT_NEAR(at_begin.second, 0.15, kNear);
  const auto at_end = SublevelInterval(from(0.95), 0.1).value();
  EXPECT_NEAR(at_end.first, 0.85, kNear);
  EXPECT_EQ(at_end.second, 1);
  const auto beyond = SublevelInterval(from(1.05), 0.1).value();
  EXPECT_NEAR(beyond.first, 0.95, kNear);
  EXPECT_EQ(beyond.second, 1);
  EXPECT_EQ(SublevelInterval(from(0.5), 0.5), (ParameterInterval{0, 1}));
  EXPECT_EQ(SublevelInterval(from(1.2), 0.1), std::nullopt);
  EXPECT_EQ(SublevelInterval([](double) { return 1.0; }, 0.5), std::nullopt);
  EXPECT_EQ(SublevelInterval([](double) { return 0.5; }, 0.5), (ParameterInterval{0, 1}));
}

TEST(SublevelInterval, IsWithinTheThresholdAtBothEndsAndAsLongAsItCanBe) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int found = 0;
  int none = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    // The maximum of the distances of a segment's point from one or two points is convex.
    const double a = 2 * uniform(engine) - 0.5, b = uniform(engine), height = uniform(engine);
    const auto distance = [&](double t) {
      return std::max(std::hypot(t - a, 0.3 * height), b * std::abs(t - 0.5));
    };
    const double threshold = 0.5 * uniform(engine);
    const auto interval = SublevelInterval(distance, threshold);
    bool any = false;
    constexpr int kSamples = 500;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = static_cast<double>(i) / kSamples;
      if (distance(t) > threshold) continue;
      any = true;
      ASSERT_TRUE(interval.has_value());
      EXPECT_GE(t, interval->first - kNear);
      EXPECT_LE(t, interval->second + kNear);
    }
    if (!interval) {
      EXPECT_FALSE(any);
      ++none;
      continue;
    }
    EXPECT_LE(interval->first, interval->second);
    EXPECT_LE(distance(interval->first), threshold);
    EXPECT_LE(distance(interval->second), threshold);
    ++found;
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(none, 100);
}

TEST(SublevelInterval, FindsAPartThatIsAsNarrowAsRoundingLeavesIt) {
  const auto distance = [](double t) { return std::abs(t - 0.3); };
  const auto interval = SublevelInterval(distance, 1e-12).value();
  EXPECT_NEAR(interval.first, 0.3, 1.1e-12);
  EXPECT_NEAR(interval.second, 0.3, 1.1e-12);
}

TEST(CoverUnitInterval, WithoutAGapInAnyOrder) {
  EXPECT_TRUE(CoverUnitInterval({{0, 1}}));
  EXPECT_TRUE(CoverUnitInterval({{-1, 2}}));
  EXPECT_TRUE(CoverUnitInterval({{0.5, 1}, {0, 0.5}}));
  EXPECT_TRUE(CoverUnitInterval({{0.2, 0.3}, {0.6, 1}, {0, 0.7}}));
  EXPECT_TRUE(CoverUnitInterval({{0, 0.9}, {0.1, 0.2}, {0.8, 1}}));
  EXPECT_FALSE(CoverUnitInterval({}));
  EXPECT_FALSE(CoverUnitInterval({{0, 0.5}, {std::nextafter(0.5, 1), 1}}));
  EXPECT_FALSE(CoverUnitInterval({{1e-300, 1}}));
  EXPECT_FALSE(CoverUnitInterval({{0, std::nextafter(1, 0)}}));
  EXPECT_FALSE(CoverUnitInterval({{0, 0.3}, {0.2, 0.4}, {0.5, 1}}));
}

}  // namespace segment_coverage_test
}  // namespace regrasp::object
