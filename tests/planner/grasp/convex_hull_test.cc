#include "planner/grasp/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "planner/base/random.h"

namespace regrasp::grasp {
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
