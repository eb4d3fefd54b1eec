#include "planner/grasp/growing_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>

#include "planner/base/random.h"

namespace regrasp::grasp {
namespace growing_hull_test {

/// Return points on the unit sphere in kDim dimensions, moved towards the origin by up to a half.
template <int kDim>
Eigen::MatrixXd RandomPoints(int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> length(0.5, 1);
  Eigen::MatrixXd points(kDim, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < kDim; ++j) points(j, i) = normal(engine);
    points.col(i) *= length(engine) / points.col(i).norm();
  }
  return points;
}

/// Insert the farthest point along the normal of the nearest facet until no point is beyond it.
/// @returns distance of the nearest facet, or −1 if the hull broke down.
template <int kDim>
double DistanceByGrowing(const Eigen::MatrixXd& points, GrowingHull<kDim>& hull) {
  hull.Start(1e-6);
  while (true) {
    const auto nearest = hull.Nearest();
    Eigen::Index farthest = 0;
    const double support = (nearest->normal.transpose() * points).maxCoeff(&farthest);
    if (support <= nearest->distance * (1 + 1e-6)) return nearest->distance;
    if (!hull.Insert(nearest->facet, points.col(farthest))) return -1;
  }
}

double DistanceByQhull(const Eigen::MatrixXd& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const HullFacet& facet : ComputeConvexHull(points).facets) {
    least = std::min(least, facet.offset);
  }
  return least;
}

template <int kDim>
void ExpectSameDistance(int count) {
  GrowingHull<kDim> hull;
  int inside = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::MatrixXd points = RandomPoints<kDim>(count, seed);
    const double expected = DistanceByQhull(points);
    if (expected < 1e-3) continue;  // the origin is outside, or too close to the boundary
    ++inside;
    const double found = DistanceByGrowing<kDim>(points, hull);
    EXPECT_NEAR(found, expected, 2e-6) << kDim << " dimensions, seed " << seed;
    EXPECT_LE(found, expected + 1e-9) << "points are shrunk, never moved outwards";
    EXPECT_LT(hull.Residual(), 1e-8);
  }
  EXPECT_GT(inside, 8);
}

TEST(GrowingHullTest, HasTheNearestFacetOfQhull) {
  ExpectSameDistance<3>(12);
  ExpectSameDistance<3>(60);
  ExpectSameDistance<6>(30);
  ExpectSameDistance<6>(60);
}

TEST(GrowingHullTest, SolvesPointsInManyCommonPlanes) {
  // Corners of a cube, and the midpoints of its edges and faces: all facets are degenerate.
  Eigen::MatrixXd points(3, 26);
  int count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        points.col(count++) = Eigen::Vector3d(x, y, z);
      }
    }
  }
  GrowingHull<3> hull;
  EXPECT_NEAR(DistanceByGrowing<3>(points, hull), 1, 1e-6);
  EXPECT_LT(hull.Residual(), 1e-8);
}

TEST(GrowingHullTest, RefusesAPointThatIsNotBeyondTheFacet) {
  GrowingHull<3> hull;
  hull.Start(1);
  const auto nearest = hull.Nearest();
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance, 1.0 / 3, 1e-12);
  EXPECT_FALSE(hull.Insert(nearest->facet, 0.9 * nearest->distance * nearest->normal));
  hull.Start(1);
  const auto again = hull.Nearest();
  EXPECT_TRUE(hull.Insert(again->facet, 2 * again->distance * again->normal));
}

TEST(GrowingHullTest, FacetsBeyondTheLimitAreNotFound) {
  GrowingHull<3> hull;
  hull.Start(1);
  hull.SetLimit(0.34);
  EXPECT_TRUE(hull.Nearest());  // all distances are 1/3
  hull.SetLimit(0.33);
  EXPECT_FALSE(hull.Nearest());
}

}  // namespace growing_hull_test

namespace convex_hull_test {

/// Return the corners of the cross-polytope of this dimension, one on each half-axis, and its
/// centre.
Eigen::MatrixXd CrossPolytopeAndCentre(int dimension) {
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(dimension, 2 * dimension + 1);
  for (int axis = 0; axis < dimension; ++axis) {
    points(axis, 2 * axis) = 1;
    points(axis, 2 * axis + 1) = -1;
  }
  return points;
}

/// Return the distance by which a point may be beyond a facet of the hull: twice the joggle of the
/// input.
double SlackOf(const ConvexHull& hull) { return 2 * hull.joggle + 1e-12; }

TEST(ConvexHull, ACrossPolytopeHasAFacetInEachOrthant) {
  for (const int dimension : {2, 3, 6}) {
    const ConvexHull hull = ComputeConvexHull(CrossPolytopeAndCentre(dimension));
    EXPECT_LT(hull.joggle, 1e-6);
    ASSERT_EQ(std::ssize(hull.facets), 1 << dimension);
    std::set<int> orthants;
    for (const HullFacet& facet : hull.facets) {
      EXPECT_NEAR(facet.normal.norm(), 1, 1e-12);
      EXPECT_NEAR(facet.offset, 1 / std::sqrt(dimension), 1e-6);
      int orthant = 0;
      for (int axis = 0; axis < dimension; ++axis) {
        EXPECT_NEAR(std::abs(facet.normal[axis]), 1 / std::sqrt(dimension), 1e-6);
        orthant = 2 * orthant + (facet.normal[axis] > 0 ? 1 : 0);
      }
      orthants.insert(orthant);
    }
    EXPECT_EQ(std::ssize(orthants), 1 << dimension);
  }
}

TEST(ConvexHull, HoldsItsPointsAndEachFacetTouchesAsManyAsTheDimension) {
  RandomStream random(1, RandomUse::kStart);
  for (const int dimension : {3, 6}) {
    Eigen::MatrixXd points(dimension, 30);
    for (double& x : points.reshaped()) x = random.Normal();
    const ConvexHull hull = ComputeConvexHull(points);
    ASSERT_GT(std::ssize(hull.facets), dimension);
    for (const HullFacet& facet : hull.facets) {
      const Eigen::VectorXd beyond =
          (facet.normal.transpose() * points).transpose().array() - facet.offset;
      EXPECT_LE(beyond.maxCoeff(), SlackOf(hull));
      EXPECT_GE((beyond.array() >= -SlackOf(hull)).count(), dimension);
      EXPECT_LT(beyond.minCoeff(), -0.1) << "all points are on a facet";
    }
  }
}

TEST(ConvexHull, RefusesPointsThatAreTooFew) {
  EXPECT_THROW((void)ComputeConvexHull(Eigen::MatrixXd::Identity(3, 3)), std::runtime_error);
}

}  // namespace convex_hull_test
}  // namespace regrasp::grasp
