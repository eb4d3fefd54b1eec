#include "planner/collision/convex_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/base/random.h"

namespace regrasp::collision {
namespace convex_shape_test {

using Eigen::Vector3d;

ConvexShape Box(const Vector3d& centre, const Vector3d& half) {
  ConvexShape box;
  for (int i = 0; i < 8; ++i) {
    box.points.push_back(centre + Vector3d((i & 1) != 0 ? half.x() : -half.x(),
                                           (i & 2) != 0 ? half.y() : -half.y(),
                                           (i & 4) != 0 ? half.z() : -half.z()));
  }
  return box;
}

Vector3d RandomVector(RandomStream& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

ConvexShape RandomHull(RandomStream& random, int points) {
  ConvexShape shape;
  for (int i = 0; i < points; ++i) shape.points.push_back(RandomVector(random));
  return shape;
}

Eigen::Isometry3d RandomPose(RandomStream& random) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
          .normalized()
          .toRotationMatrix();
  pose.translation() = 3 * RandomVector(random);
  return pose;
}

TEST(ConvexShapeTest, KnownDistances) {
  const ConvexShape ball{{Vector3d(0, 0, 3)}, 1};
  const ConvexShape capsule{{Vector3d(-5, 0, 0), Vector3d(5, 0, 0)}, 0.5};
  EXPECT_NEAR(Distance(ball, capsule).lower, 1.5, 1e-12);
  EXPECT_NEAR(Distance(ball, capsule).upper, 1.5, 1e-12);
  const ConvexShape box = Box({0, 0, 0}, {1, 1, 1});
  // Vertex to vertex, edge to edge, face to face, and a corner to the middle of a face.
  EXPECT_NEAR(Distance(box, Box({4, 4, 4}, {1, 1, 1})).lower, 2 * std::sqrt(3.0), 1e-8);
  EXPECT_NEAR(Distance(box, Box({4, 4, 0}, {1, 1, 5})).lower, 2 * std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(Distance(box, Box({0.3, 0.2, 4}, {1, 1, 1})).lower, 2, 1e-8);
  EXPECT_NEAR(Distance(box, {{Vector3d(0.1, 0.2, 1.25), Vector3d(7, 7, 9)}, 0}).lower, 0.25, 1e-8);
}

TEST(ConvexShapeTest, ShapesThatOverlapHaveNoDistance) {
  const ConvexShape box = Box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(Distance(box, Box({1.5, 0.3, 0.1}, {1, 1, 1})).upper, 0);
  EXPECT_EQ(Distance(box, Box({0, 0, 0}, {0.1, 0.1, 0.1})).upper, 0);
  EXPECT_EQ(Distance(box, {{Vector3d(0, 0, 1.4)}, 0.5}).upper, 0);
  EXPECT_EQ(Distance(box, box).upper, 0);
  EXPECT_FALSE(AreApart(box, box, 0));
  // Touching shapes are not apart.
  EXPECT_FALSE(AreApart(box, Box({2, 0, 0}, {1, 1, 1}), 0));
}

/// Independent bounds: the separation along any direction is a lower bound, the distance of any two
/// points an upper bound.
TEST(ConvexShapeTest, BoundsHoldAndMeetOnRandomHulls) {
  RandomStream random(1, RandomUse::kCandidates);
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const ConvexShape a = RandomHull(random, 1 + static_cast<int>(random.Index(12)));
    const ConvexShape b =
        Moved(RandomPose(random), RandomHull(random, 1 + static_cast<int>(random.Index(12))));
    const DistanceBounds bounds = Distance(a, b);
    ASSERT_LE(bounds.lower, bounds.upper);
    ASSERT_NEAR(bounds.lower, bounds.upper, 1e-8 * bounds.upper + 1e-12);
    // No convex combination of points of both shapes is nearer.
    for (int j = 0; j < 20; ++j) {
      const auto draw = [&](const ConvexShape& shape) {
        Vector3d sum = Vector3d::Zero();
        double weights = 0;
        for (const Vector3d& point : shape.points) {
          const double weight = std::pow(random.Uniform(), 8);
          sum += weight * point;
          weights += weight;
        }
        return Vector3d(sum / weights);
      };
      ASSERT_GE((draw(a) - draw(b)).norm(), bounds.lower * (1 - 1e-12));
    }
    apart += static_cast<int>(bounds.lower > 0);
  }
  EXPECT_GT(apart, 500);
  EXPECT_LT(apart, 2000);
}

TEST(ConvexShapeTest, TheAnswerWhetherTheyAreApartIsThatOfTheDistance) {
  RandomStream random(2, RandomUse::kCandidates);
  int yes = 0;
  for (int i = 0; i < 2000; ++i) {
    ConvexShape a = RandomHull(random, 5);
    a.radius = random.Uniform();
    const ConvexShape b = Moved(RandomPose(random), RandomHull(random, 3));
    const double distance = Distance(a, b).lower;
    ASSERT_EQ(AreApart(a, b, 0.5), distance > 0.5) << i;
    if (distance > 0) {
      ASSERT_TRUE(AreApart(a, b, distance * (1 - 1e-6)));
      ASSERT_FALSE(AreApart(a, b, distance * (1 + 1e-6)));
    }
    yes += static_cast<int>(distance > 0.5);
  }
  EXPECT_GT(yes, 500);
  EXPECT_LT(yes, 2000);
}

/// Posed shapes are compared with the distance of the moved shapes.
TEST(ConvexShapeTest, PosedShapesAreApartIfTheirMovedShapesAre) {
  RandomStream random(8, RandomUse::kCandidates);
  const auto posed = [&](const ConvexShape& shape) {
    PosedShape one{&shape, RandomPose(random), BoundingSphereOf(shape)};
    one.sphere.centre = one.pose * one.sphere.centre;
    return one;
  };
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    ConvexShape a = RandomHull(random, 6);
    a.radius = random.Uniform();
    const ConvexShape b = RandomHull(random, 1 + static_cast<int>(random.Index(8)));
    const PosedShape at_a = posed(a);
    const PosedShape at_b = posed(b);
    const double distance = Distance(ShapeOf(at_a), ShapeOf(at_b)).lower;
    ASSERT_EQ(AreApart(at_a, at_b, 0.5), distance > 0.5) << i;
    if (distance > 0) {
      ASSERT_TRUE(AreApart(at_a, at_b, distance * (1 - 1e-6)));
      ASSERT_FALSE(AreApart(at_a, at_b, distance * (1 + 1e-6)));
    }
    const Eigen::Isometry3d motion = RandomPose(random);
    ASSERT_EQ(AreApart(Moved(motion, at_a), Moved(motion, at_b), 0.5), distance > 0.5);
    apart += static_cast<int>(distance > 0.5);
  }
  EXPECT_GT(apart, 500);
  EXPECT_LT(apart, 2000);
  const ConvexShape box = Box({0, 0, 0}, {1, 1, 1});
  const PosedShape same{&box, Eigen::Isometry3d::Identity(), BoundingSphereOf(box)};
  EXPECT_FALSE(AreApart(same, same, 0)) << "equal centres have no direction";
}

TEST(ConvexShapeTest, AlongTheDirectionThatWasFoundHullsAreApartAndAlongNoOtherMore) {
  RandomStream random(7, RandomUse::kCandidates);
  for (int i = 0; i < 500; ++i) {
    const ConvexShape a = RandomHull(random, 6);
    const ConvexShape b = Moved(RandomPose(random), RandomHull(random, 4));
    const HullBounds bounds = HullDistance(a.points, b.points);
    if (bounds.lower == 0) continue;
    ASSERT_TRUE(AreApartAlong(a.points, b.points, 3 * bounds.direction, bounds.lower * (1 - 1e-6)));
    ASSERT_FALSE(AreApartAlong(a.points, b.points, bounds.direction, bounds.upper * (1 + 1e-6)));
    ASSERT_FALSE(AreApartAlong(a.points, b.points, -bounds.direction, 0));
    const Vector3d other(random.Normal(), random.Normal(), random.Normal());
    ASSERT_FALSE(AreApartAlong(a.points, b.points, other, bounds.upper * (1 + 1e-6)));
  }
  EXPECT_FALSE(AreApartAlong(std::array{Vector3d(1, 0, 0)}, std::array{Vector3d(0, 0, 0)},
                             Vector3d::Zero(), 0))
      << "no direction tells nothing";
}

TEST(ConvexShapeTest, MotionOrderAndExchangeChangeNothing) {
  RandomStream random(3, RandomUse::kCandidates);
  for (int i = 0; i < 300; ++i) {
    const ConvexShape a = RandomHull(random, 6);
    const ConvexShape b = Moved(RandomPose(random), RandomHull(random, 7));
    const double distance = Distance(a, b).lower;
    const Eigen::Isometry3d pose = RandomPose(random);
    EXPECT_NEAR(Distance(Moved(pose, a), Moved(pose, b)).lower, distance, 1e-7 * (1 + distance));
    EXPECT_NEAR(Distance(b, a).lower, distance, 1e-7 * (1 + distance));
    ConvexShape turned = a;
    std::reverse(turned.points.begin(), turned.points.end());
    EXPECT_NEAR(Distance(turned, b).lower, distance, 1e-7 * (1 + distance));
    ConvexShape larger = a;
    larger.points.push_back(RandomVector(random));
    EXPECT_LE(Distance(larger, b).lower, distance * (1 + 1e-7));
  }
}

TEST(ConvexShapeTest, TheBallContainsTheShape) {
  RandomStream random(4, RandomUse::kCandidates);
  for (int i = 0; i < 100; ++i) {
    ConvexShape shape = RandomHull(random, 9);
    shape.radius = 0.25;
    const BoundingSphere ball = BoundingSphereOf(shape);
    for (const Vector3d& point : shape.points) {
      EXPECT_LE((point - ball.centre).norm() + shape.radius, ball.radius * (1 + 1e-12));
    }
  }
}

TEST(ConvexShapeTest, AnEnclosingShapeContainsTheShapeWithFewPoints) {
  RandomStream random(5, RandomUse::kCandidates);
  ConvexShape ball;
  for (int i = 0; i < 400; ++i) ball.points.push_back(RandomVector(random).normalized());
  ball.radius = 0.1;
  std::size_t before = ball.points.size();
  for (const double tolerance : {0.01, 0.05, 0.2}) {
    const ConvexShape enclosing = Enclosing(ball, tolerance);
    EXPECT_LE(enclosing.radius, ball.radius + tolerance);
    EXPECT_LT(enclosing.points.size(), before);
    before = enclosing.points.size();
    for (const Vector3d& point : ball.points) {
      EXPECT_LE(Distance({{point}, 0}, {enclosing.points, 0}).lower + ball.radius,
                enclosing.radius * (1 + 1e-9));
    }
  }
  EXPECT_LT(before, 40U);
  // Few points remain themselves.
  const ConvexShape box = Box({1, 2, 3}, {1, 1, 2});
  EXPECT_EQ(Enclosing(box, 1e-3).points.size(), 8U);
  EXPECT_LT(Enclosing(box, 1e-3).radius, 1e-9);
  EXPECT_EQ(Enclosing({{Vector3d(1, 0, 0)}, 2}, 1e-3).radius, 2);
}

}  // namespace convex_shape_test
}  // namespace regrasp::collision
