#include <gtest/gtest.h>

#include <vector>

#include "planner/base/random.h"
#include "planner/collision/convex_shape.h"

namespace regrasp::collision {
namespace nearest_points_test {

using Eigen::Vector3d;

Vector3d Draw(RandomStream& random) {
  Vector3d drawn;
  for (double& x : drawn) x = random.Normal();
  return drawn;
}

/// The planes through the two points separate the hulls, so no other points are nearer.
TEST(NearestPointsTest, ThePlaneThroughEachIsAtTheHull) {
  RandomStream random(2, RandomUse::kTrialContacts);
  int apart = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<Vector3d> a;
    std::vector<Vector3d> b;
    for (int k = 0; k < 1 + i % 12; ++k) {
      a.push_back(Draw(random) + 2 * Vector3d::UnitZ());
      if (k < 3) b.push_back(Draw(random) - 2 * Vector3d::UnitZ());
    }
    const auto pair = FindNearestPoints(a, b);
    const DistanceBounds bounds = Distance({a, 0}, {b, 0});
    EXPECT_EQ(pair.has_value(), bounds.upper > 0) << i;
    if (!pair) continue;
    const Vector3d normal = (pair->on_a - pair->on_b).normalized();
    for (const Vector3d& point : a) EXPECT_GE(normal.dot(point - pair->on_a), -1e-6) << i;
    for (const Vector3d& point : b) EXPECT_LE(normal.dot(point - pair->on_b), 1e-6) << i;
    EXPECT_NEAR((pair->on_a - pair->on_b).norm(), bounds.upper, 1e-7) << i;
    ++apart;
  }
  EXPECT_GT(apart, 100);
}

}  // namespace nearest_points_test
}  // namespace regrasp::collision
