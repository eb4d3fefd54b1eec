#include "render/figures/region_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regrasp::render {
namespace region_lines_test {

using Eigen::Vector2d;

constexpr int kSide = 100;

/// Return the area of even-odd outlines of one region, from their signed areas.
double AreaOf(const std::vector<Polyline>& outlines) {
  double largest = 0, sum = 0;
  for (const Polyline& line : outlines) {
    double area = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      area += (line[i - 1].x() * line[i].y() - line[i - 1].y() * line[i].x()) / 2;
    }
    largest = std::max(largest, std::abs(area));
    sum += std::abs(area);
  }
  return 2 * largest - sum;  // holes count negatively
}

double LengthOf(const std::vector<Polyline>& lines) {
  double length = 0;
  for (const Polyline& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  }
  return length;
}

/// Return the lines between the samples of a half plane a x + b y < c and the others.
std::vector<Polyline> HalfPlane(double a, double b, double c, double shortest = 0) {
  SampleSides sides(kSide, kSide);
  const auto inside = [&](int x, int y) { return a * x + b * y < c; };
  sides.AddBetween([&](int x, int y, int u, int v) { return inside(x, y) != inside(u, v); });
  return sides.Trace(shortest);
}

TEST(RegionLines, ASlopingBorderIsOneNearlyStraightLine) {
  for (const double slope : {0.0, 0.3, 1.0, 2.7}) {
    const std::vector<Polyline> lines = HalfPlane(slope, 1, 60);
    ASSERT_EQ(lines.size(), 1u) << slope;
    EXPECT_LE(lines[0].size(), 6u) << slope;
    for (const Vector2d& p : lines[0]) {
      const double away = (slope * (p.x() - 0.5) + p.y() - 0.5 - 60) / std::hypot(slope, 1);
      EXPECT_LT(std::abs(away), 1.2) << slope;
    }
  }
}

TEST(RegionLines, ShortLinesAreOmitted) {
  EXPECT_EQ(HalfPlane(0, 1, 60, kSide).size(), 1u);
  EXPECT_TRUE(HalfPlane(0, 1, 60, kSide + 1).empty());
}

TEST(RegionLines, LinesEndWhereThreeRegionsMeet) {
  SampleSides sides(kSide, kSide);
  const auto region = [](int x, int y) { return y < 50 ? 0 : x < 50 ? 1 : 2; };
  sides.AddBetween([&](int x, int y, int u, int v) { return region(x, y) != region(u, v); });
  const std::vector<Polyline> lines = sides.Trace(0);
  ASSERT_EQ(lines.size(), 3u);
  for (const Polyline& line : lines) {
    const bool meets = line.front() == Vector2d(50, 50) || line.back() == Vector2d(50, 50);
    EXPECT_TRUE(meets);
  }
}

TEST(RegionLines, OutlinesCoverTheRegionWithItsHole) {
  const auto ring = [](int x, int y) {
    const double r = std::hypot(x - 50, y - 50);
    return r < 40 && r > 20;
  };
  const std::vector<Polyline> outlines = OutlineOf(kSide, kSide, 0, ring);
  ASSERT_EQ(outlines.size(), 2u);
  for (const Polyline& outline : outlines) EXPECT_EQ(outline.front(), outline.back());
  EXPECT_NEAR(AreaOf(outlines), M_PI * (40 * 40 - 20 * 20), 0.04 * M_PI * 40 * 40);
  EXPECT_NEAR(LengthOf(outlines), 2 * M_PI * 60, 0.04 * 2 * M_PI * 60);
  // Without small parts: the hole has a width of about 40.
  EXPECT_EQ(OutlineOf(kSide, kSide, 50, ring).size(), 1u);
}

TEST(RegionLines, ARegionEndsAtTheBorderOfTheImage) {
  const std::vector<Polyline> all = OutlineOf(kSide, kSide, 0, [](int, int) { return true; });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(AreaOf(all), kSide * kSide, 0.02 * kSide * kSide);
  EXPECT_TRUE(OutlineOf(kSide, kSide, 0, [](int, int) { return false; }).empty());
}

TEST(RegionLines, PartsThatTouchAtACornerAreCovered) {
  const auto two = [](int x, int y) { return (x < 50) == (y < 50) && x > 20 && y > 20; };
  double area = 0;
  for (const Polyline& outline : OutlineOf(kSide, kSide, 0, two)) {
    EXPECT_EQ(outline.front(), outline.back());
    double signed_area = 0;
    for (std::size_t i = 1; i < outline.size(); ++i) {
      signed_area += outline[i - 1].x() * outline[i].y() - outline[i - 1].y() * outline[i].x();
    }
    area += std::abs(signed_area) / 2;
  }
  EXPECT_NEAR(area, 29 * 29 + 50 * 50, 150);
}

}  // namespace region_lines_test
}  // namespace regrasp::render
