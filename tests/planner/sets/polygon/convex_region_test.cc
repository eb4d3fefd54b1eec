#include "planner/sets/polygon/convex_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace regrasp::polygon {
namespace convex_region_test {

template <class NT>
HalfPlane<NT> Make(double a, double b, double c) {
  return {NT(a), NT(b), NT(c)};
}

/// Return the part of the unit square inside half-planes a x + b y + c > 0.
std::optional<FilteredRegion> Cut(const std::vector<std::array<double, 3>>& cuts) {
  return FilteredRegion::Make([cuts](auto zero) {
    using NT = decltype(zero);
    auto region = ConvexRegion<NT>::UnitSquare();
    for (const auto& [a, b, c] : cuts) region.Clip(Make<NT>(a, b, c));
    return region;
  });
}

double Middle(const Interval& x) { return (x.inf() + x.sup()) / 2; }

double Area(const ConvexRegion<Interval>& region) {
  double twice = 0;
  const auto& sides = region.sides();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto& p = sides[k].from;
    const auto& q = sides[(k + 1) % sides.size()].from;
    twice += (Middle(p.x) * Middle(q.y) - Middle(p.y) * Middle(q.x)) / (Middle(p.w) * Middle(q.w));
  }
  return twice / 2;
}

class ConvexRegionTest : public testing::Test {
 private:
  IntervalScope scope_;
};

TEST_F(ConvexRegionTest, CutsKeepTheAreaThatIsInside) {
  const struct {
    std::vector<std::array<double, 3>> cuts;
    double area;
    std::size_t sides;
  } cases[] = {
      {{}, 1, 4},
      {{{1, 1, -1}}, 0.5, 3},      // through two corners
      {{{1, 1, -0.5}}, 0.875, 5},  // cuts off a corner
      {{{1, 0, -0.25}}, 0.75, 4},  // parallel to two sides
      {{{1, 1, 0}}, 1, 4},         // touches a corner
      {{{0, 1, 0}}, 1, 4},         // a side of the square
      {{{1, 1, -0.5}, {-1, -1, 1.5}}, 0.75, 6},
      {{{1, 1, -1}, {1, -1, 0}}, 0.25, 3},  // three borders through one point
  };
  for (const auto& c : cases) {
    const auto region = Cut(c.cuts);
    ASSERT_TRUE(region.has_value());
    EXPECT_NEAR(Area(region->region()), c.area, 1e-12);
    EXPECT_EQ(region->region().sides().size(), c.sides);
    EXPECT_EQ(region->exact().sides().size(), c.sides);
  }
}

TEST_F(ConvexRegionTest, WhatHasNoInteriorIsEmpty) {
  EXPECT_FALSE(Cut({{-1, -1, 0}}));              // a corner
  EXPECT_FALSE(Cut({{0, -1, 0}}));               // a side
  EXPECT_FALSE(Cut({{1, 1, -1}, {-1, -1, 1}}));  // a diagonal
  EXPECT_FALSE(Cut({{1, 0, -2}}));               // outside
  EXPECT_TRUE(Cut({{-1, -1, 0x1p-1000}}));       // very small, but not empty
}

TEST_F(ConvexRegionTest, RegionsThatTouchDoNotOverlap) {
  const auto lower = Cut({{0, -1, 0.5}});
  const auto upper = Cut({{0, 1, -0.5}});
  EXPECT_FALSE(FilteredRegion::Overlap(*lower, *upper));
  EXPECT_TRUE(FilteredRegion::Overlap(*lower, *lower));
  const auto corner = Cut({{0, 1, -0.5}, {1, 0, -0.5}});
  const auto opposite = Cut({{0, -1, 0.5}, {-1, 0, 0.5}});
  EXPECT_FALSE(FilteredRegion::Overlap(*corner, *opposite));
  // A single rounding up or down decides.
  const auto above = Cut({{0, 1, -std::nextafter(0.5, 0)}});
  const auto below = Cut({{0, 1, -std::nextafter(0.5, 1)}});
  EXPECT_TRUE(FilteredRegion::Overlap(*lower, *above));
  EXPECT_FALSE(FilteredRegion::Overlap(*lower, *below));
}

TEST_F(ConvexRegionTest, ARegionThatReachesInfinityIsCutLikeAnyOther) {
  // Region above the segment from (0, 0) to (1, 0), between diverging rays.
  const auto wedge = [](auto zero, double cut) {
    using NT = decltype(zero);
    ConvexRegion<NT> region(
        {Make<NT>(0, 1, 0), Make<NT>(-1, 1, 1), Make<NT>(0, 0, 1), Make<NT>(1, 1, 0)}, {});
    region.Clip(Make<NT>(0, -1, cut));
    return region;
  };
  const auto bounded = FilteredRegion::Make([&](auto zero) { return wedge(zero, 2); });
  ASSERT_TRUE(bounded.has_value());
  EXPECT_EQ(bounded->region().sides().size(), 4);
  EXPECT_NEAR(Area(bounded->region()), 2 + 4, 1e-12);
  EXPECT_FALSE(FilteredRegion::Make([&](auto zero) { return wedge(zero, 0); }));
}

TEST_F(ConvexRegionTest, OverlapIsDecidedAsByCuttingOneWithTheOther) {
  std::mt19937_64 random(7);
  // Coordinates on a coarse grid, so that many regions touch.
  const auto draw = [&](int count) { return static_cast<double>(random() % count); };
  int overlapping = 0;
  int apart = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<std::array<double, 3>> cuts[2];
    for (auto& list : cuts) {
      for (int k = 0; k < 3; ++k) list.push_back({draw(5) - 2, draw(5) - 2, (draw(9) - 4) / 4});
    }
    const auto a = Cut(cuts[0]);
    const auto b = Cut(cuts[1]);
    if (!a || !b) continue;
    cuts[0].insert(cuts[0].end(), cuts[1].begin(), cuts[1].end());
    const bool common = Cut(cuts[0]).has_value();
    EXPECT_EQ(FilteredRegion::Overlap(*a, *b), common) << "trial " << trial;
    EXPECT_EQ(FilteredRegion::Overlap(*b, *a), common) << "trial " << trial;
    ++(common ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_GT(apart, 100);
}

}  // namespace convex_region_test
}  // namespace regrasp::polygon
