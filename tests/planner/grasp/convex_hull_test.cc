#include "planner/grasp/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "planner/base/random.h"

namespace regrasp::grasp {
namespace {

/// The corners of the cube of so many dimensions, half of whose side is 1, and its centre.
Eigen::MatrixXd CubeAndCentre(int dimension) {
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(dimension, (1 << dimension) + 1);
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    for (int axis = 0; axis < dimension; ++axis) points(axis, corner) = corner >> axis & 1 ? 1 : -1;
  }
  return points;
}

/// How far a point may lie beyond a facet: what the input was joggled by, both ways.
double SlackOf(const ConvexHull& hull) { return 2 * hull.joggle + 1e-12; }

TEST(ConvexHull, FacetsOfACubeAreItsSidesAndTheCentreIsOnNone) {
  for (const int dimension : {2, 3, 6}) {
    const ConvexHull hull = ComputeConvexHull(CubeAndCentre(dimension));
    EXPECT_LT(hull.joggle, 1e-6);
    ASSERT_GE(std::ssize(hull.facets), 2 * dimension);
    std::vector<bool> seen(2 * dimension, false);
    for (const HullFacet& facet : hull.facets) {
      EXPECT_NEAR(facet.normal.norm(), 1, 1e-12);
      EXPECT_NEAR(facet.offset, 1, 1e-6);
      int axis = 0;
      EXPECT_NEAR(facet.normal.cwiseAbs().maxCoeff(&axis), 1, 1e-6);
      seen[2 * axis + (facet.normal[axis] > 0 ? 1 : 0)] = true;
    }
    EXPECT_EQ(std::ranges::count(seen, true), 2 * dimension);
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

}  // namespace
}  // namespace regrasp::grasp
