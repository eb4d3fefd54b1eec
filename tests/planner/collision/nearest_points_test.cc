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

std::vector<Vector3d> Cloud(RandomStream& random, int size) {
  std::vector<Vector3d> points;
  for (int k = 0; k < size; ++k) points.push_back(Draw(random) + 3 * Vector3d::UnitZ());
  return points;
}

TEST(PointTreeTest, TheFarthestPointIsThatOfAllPoints) {
  RandomStream random(3, RandomUse::kTrialContacts);
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1, -2, 0.5) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
  for (const int size : {1, 7, 8, 9, 100, 1000}) {
    std::vector<Vector3d> points = Cloud(random, size);
    PointTree tree(points);
    tree.Move(pose);
    for (Vector3d& point : points) point = pose * point;
    ASSERT_EQ(tree.points().size(), points.size());
    for (int i = 0; i < 100; ++i) {
      const Vector3d direction = Draw(random);
      EXPECT_EQ(Farthest(tree, direction).dot(direction),
                Farthest(points, direction).dot(direction));
    }
  }
}

TEST(PointTreeTest, NearestPointsAreThoseOfAllPointsUpToTheLargestDistanceThatMatters) {
  RandomStream random(4, RandomUse::kTrialContacts);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vector3d> a = Cloud(random, 1 + i);
    const std::vector<Vector3d> b = {Draw(random), Draw(random), Draw(random)};
    const auto expected = FindNearestPoints(a, b);
    const PointTree tree(a);
    const auto all = FindNearestPoints(tree, b, 1e9);
    ASSERT_EQ(all.has_value(), expected.has_value());
    if (!expected) continue;
    ++apart;
    const double distance = (expected->on_a - expected->on_b).norm();
    EXPECT_NEAR((all->on_a - all->on_b).norm(), distance, 1e-7);
    const auto above = FindNearestPoints(tree, b, 1.01 * distance);
    EXPECT_NEAR((above->on_a - above->on_b).norm(), distance, 1e-7);
    const auto below = FindNearestPoints(tree, b, 0.5 * distance);
    EXPECT_GE((below->on_a - below->on_b).norm(), distance - 1e-7);
  }
  EXPECT_GT(apart, 50);
}

}  // namespace nearest_points_test
}  // namespace regrasp::collision
