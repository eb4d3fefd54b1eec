#include <gtest/gtest.h>

#include <cmath>

#include "planner/criteria/reach.h"
#include "planner/object/polygon.h"

namespace regrasp::criteria {
namespace clearance_test {

/// Return an L-shaped polygon with its inner corner at (1, 1). The edges from (1, 1) extend upwards
/// and to the right.
object::Polygon MakeL() {
  return object::Polygon::FromRings({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, "L");
}

/// Return a contact on the edge from (2, 1) to (1, 1), at a distance from the inner corner.
grasp::Contact NearInnerCorner(const object::Polygon& polygon, double distance) {
  return {{1 + distance, 1, 0}, polygon.inward_normal(FaceIndex(2)), FaceIndex(2)};
}

TEST(FingertipClearance, EndsWhereTheBallTouchesTheOtherSideOfAConcaveCorner) {
  const object::Polygon polygon = MakeL();
  // At a right angle the sphere's radius equals the distance from the corner.
  const double radius = kFingertipClearance * polygon.diameter();
  EXPECT_FALSE(HasClearance(polygon, NearInnerCorner(polygon, 0)));
  EXPECT_FALSE(HasClearance(polygon, NearInnerCorner(polygon, 0.99 * radius)));
  EXPECT_TRUE(HasClearance(polygon, NearInnerCorner(polygon, 1.01 * radius)));
}

TEST(FingertipClearance, IsThereAtConvexCornersAndBetweenCollinearEdges) {
  const object::Polygon polygon = MakeL();
  EXPECT_TRUE(
      HasClearance(polygon, {{2, 1, 0}, polygon.inward_normal(FaceIndex(2)), FaceIndex(2)}));
  EXPECT_TRUE(
      HasClearance(polygon, {{2, 1, 0}, polygon.inward_normal(FaceIndex(1)), FaceIndex(1)}));
  const object::Polygon cut =
      object::Polygon::FromRings({{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}}, "cut");
  for (const double x : {1.0, 1.0 - 1e-9, 1.0 - 1e-4}) {
    EXPECT_TRUE(HasClearance(cut, {{x, 0, 0}, cut.inward_normal(FaceIndex(0)), FaceIndex(0)})) << x;
  }
}

TEST(FingertipClearance, DoesNotDependOnTheUnitOfLength) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Eigen::Vector2d> ring = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (Eigen::Vector2d& p : ring) p *= scale;
    const object::Polygon polygon = object::Polygon::FromRings({ring}, "L");
    const double radius = kFingertipClearance * polygon.diameter();
    for (const double share : {0.9, 1.1}) {
      const grasp::Contact contact = {
          {scale + share * radius, scale, 0}, polygon.inward_normal(FaceIndex(2)), FaceIndex(2)};
      EXPECT_EQ(HasClearance(polygon, contact), share > 1) << scale;
    }
  }
}

}  // namespace clearance_test
}  // namespace regrasp::criteria
