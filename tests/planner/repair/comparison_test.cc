#include "planner/repair/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace comparison_test {

using object::PolygonSoup;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

/// Split each quadrilateral into two triangles.
PolygonSoup Cut(const PolygonSoup& soup) {
  PolygonSoup cut{soup.vertices, {}};
  for (const auto& f : soup.facets) {
    cut.facets.push_back({f[0], f[1], f[2]});
    if (f.size() == 4) cut.facets.push_back({f[0], f[2], f[3]});
  }
  return cut;
}

PolygonSoup Box(double half) {
  return Cut(BoxSoup(Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half)));
}

TEST(Comparison, OfASurfaceWithItselfIsNothing) {
  const Comparison same = Compare(Box(1), Box(1), 1);
  EXPECT_EQ(same.to_solid.largest, 0);
  EXPECT_EQ(same.seen_most, 0);
  EXPECT_EQ(same.normal_most, 0);
  EXPECT_EQ(same.seen_share, 1);
  EXPECT_EQ(same.filled_share, 0);
}

TEST(Comparison, OfABoxWithALargerOneKnowsTheDistances) {
  const double diameter = 2 * std::sqrt(3);
  const Comparison grown = Compare(Box(1), Box(1.1), diameter);
  EXPECT_NEAR(grown.to_solid.mean, 0.1, 1e-9);
  EXPECT_NEAR(grown.to_solid.largest, 0.1, 1e-9);
  EXPECT_GE(grown.to_solid.bound, 0.1);
  // The distance is the same everywhere, so no piece can be pruned, and the number of pieces is
  // limited.
  EXPECT_LE(grown.to_solid.bound, 0.12);
  // The corners of the larger box are farthest, and no sample is there.
  const double corner = 0.1 * std::sqrt(3);
  EXPECT_LT(grown.to_original.largest, corner);
  EXPECT_GE(grown.to_original.bound, corner);
  EXPECT_LE(grown.to_original.bound, corner + 2e-3 * diameter);
  EXPECT_EQ(grown.filled_share, 1);
  EXPECT_EQ(grown.thin_share, 0);
}

TEST(Comparison, OfAFacetThatIsCutAnewTheBoundIsTight) {
  // A degenerate triangle is wholly inside a triangle of the original, so its corners give a tight
  // bound.
  PolygonSoup whole{{{0, 0, 0}, {1, 0, 0}, {0, 1e-4, 0}}, {{0, 1, 2}}};
  PolygonSoup cut = whole;
  cut.vertices.emplace_back(0.5, 0, 0);
  cut.facets = {{0, 3, 2}, {3, 1, 2}};
  const Comparison same = Compare(whole, cut, 1);
  EXPECT_LE(same.to_original.bound, 1e-3 + 1e-12);
  EXPECT_EQ(same.filled_share, 0);
}

TEST(Comparison, OfAPartOnlyItsOwnOriginalCounts) {
  const PolygonSoup left = Box(1);
  PolygonSoup right = left;
  for (Eigen::Vector3d& v : right.vertices) v.x() += 5;
  const PolygonSoup both = Join(left, right);
  for (const PolygonSoup& part : {left, right}) {
    const PolygonSoup its = OriginalOfPart(both, both, part);
    EXPECT_EQ(its.facets.size(), part.facets.size());
    EXPECT_NEAR(Compare(its, part, 1).to_solid.largest, 0, 1e-12);
  }
  EXPECT_GT(Compare(both, left, 1).to_solid.largest, 1);
}

TEST(Comparison, NormalsAreThoseOfTheNearestFacet) {
  PolygonSoup flat = BoxSoup({-1, -1, 0}, {1, 1, 1});
  flat.facets.resize(1);
  PolygonSoup tilted = flat;
  const double angle = 0.1;
  Transform(tilted, Eigen::Affine3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX())));
  const Comparison comparison = Compare(Cut(flat), Cut(tilted), 2 * std::sqrt(2));
  EXPECT_NEAR(comparison.normal_mean, angle, 1e-9);
  EXPECT_NEAR(comparison.normal_most, angle, 1e-9);
}

TEST(Comparison, WhatIsInsideIsNotSeen) {
  // A box inside a box of twice the size has a fifth of the total area.
  const PolygonSoup nested =
      Cut(Join(BoxSoup({-1, -1, -1}, {1, 1, 1}), BoxSoup({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})));
  const Comparison comparison = Compare(nested, Box(1), 2 * std::sqrt(3));
  EXPECT_NEAR(comparison.seen_share, 0.8, 0.01);
  EXPECT_EQ(comparison.seen_most, 0);
  EXPECT_GT(comparison.to_solid.largest, 0.4);
}

TEST(Comparison, AThinWallIsFound) {
  const PolygonSoup thin = Cut(BoxSoup({-1, -1, -0.001}, {1, 1, 0.001}));
  EXPECT_GT(Compare(thin, thin, 2 * std::sqrt(2)).thin_share, 0.95);
}

}  // namespace comparison_test
}  // namespace regrasp::repair
