#include "planner/kinematics/fit_tip.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "planner/base/random.h"

namespace regrasp::kinematics {
namespace fit_tip_test {

using collision::ConvexShape;
using Eigen::Vector3d;

TipDirections Directions() { return {Vector3d::UnitZ(), Vector3d::UnitX()}; }

ConvexShape Box(const Vector3d& half) {
  ConvexShape box;
  for (int corner = 0; corner < 8; ++corner) {
    box.points.push_back(half.cwiseProduct(Vector3d(
        (corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1)));
  }
  return box;
}

ConvexShape Sphere(const Vector3d& centre, double radius) {
  ConvexShape sphere;
  RandomStream random(5, RandomUse::kCandidates);
  while (sphere.points.size() < 600) {
    Vector3d point;
    for (int i = 0; i < 3; ++i) point[i] = 2 * random.Uniform() - 1;
    if (point.norm() > 1 || point.norm() < 0.1) continue;
    sphere.points.push_back(centre + radius * point.normalized());
  }
  return sphere;
}

TEST(FitTipTest, OfABoxItIsTheLargestBallAtItsEndAndPad) {
  const FittedBall fitted = FitTip(Box({0.008, 0.006, 0.02}), Directions());
  EXPECT_NEAR(fitted.ball.radius, 0.006, 1e-9);
  EXPECT_LT((fitted.ball.centre - Vector3d(0.002, 0, 0.014)).norm(), 1e-9);
  EXPECT_NEAR(fitted.short_of_far, 0, 1e-9);
  EXPECT_NEAR(fitted.short_of_pad, 0, 1e-9);
}

TEST(FitTipTest, WhereItMayBeAnywhereAcrossItIsInTheMiddle) {
  const FittedBall fitted = FitTip(Box({0.006, 0.02, 0.02}), Directions());
  EXPECT_LT((fitted.ball.centre - Vector3d(0, 0, 0.014)).norm(), 1e-9);
}

TEST(FitTipTest, OfABallItIsThatBall) {
  const FittedBall fitted = FitTip(Sphere({0.01, 0.02, 0.03}, 0.008), Directions());
  EXPECT_NEAR(fitted.ball.radius, 0.008, 0.0003);
  EXPECT_LT((fitted.ball.centre - Vector3d(0.01, 0.02, 0.03)).norm(), 0.0004);
}

TEST(FitTipTest, OfACapsuleItIsTheBallOfItsFarEnd) {
  const FittedBall fitted = FitTip({{{0, 0, -0.01}, {0, 0, 0.02}}, 0.005}, Directions());
  EXPECT_EQ(fitted.ball.centre, Vector3d(0, 0, 0.02));
  EXPECT_EQ(fitted.ball.radius, 0.005);
}

TEST(FitTipTest, ItIsInsideAndMovesAlongWithTheShape) {
  RandomStream random(6, RandomUse::kCandidates);
  int checked = 0;
  for (int i = 0; i < 20; ++i) {
    ConvexShape shape = Sphere({0, 0, 0.01}, 0.006);
    shape.points.emplace_back(0, 0, -0.02);
    shape.points.emplace_back(0.006 * random.Uniform(), 0.004, 0.016);
    const FittedBall fitted = FitTip(shape, Directions());
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(0.1, random.Uniform(), -0.2) *
        Eigen::AngleAxisd(3 * random.Uniform(), Vector3d(1, 2, random.Uniform()).normalized());
    const FittedBall moved = FitTip(
        Moved(pose, shape), {pose.linear() * Vector3d::UnitZ(), pose.linear() * Vector3d::UnitX()});
    EXPECT_LT((moved.ball.centre - pose * fitted.ball.centre).norm(), 1e-6);
    EXPECT_NEAR(moved.ball.radius, fitted.ball.radius, 1e-6);
    // In no direction does the sphere protrude from the shape.
    for (int k = 0; k < 50; ++k) {
      const Vector3d direction =
          Vector3d(random.Uniform() - 0.5, random.Uniform() - 0.5, random.Uniform() - 0.5)
              .normalized();
      double farthest = -1;
      for (const Vector3d& p : shape.points) farthest = std::max(farthest, p.dot(direction));
      EXPECT_LE(fitted.ball.centre.dot(direction) + fitted.ball.radius, farthest + 1e-7);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 1000);
}

TEST(FitTipTest, FlatShapesAreRefused) {
  EXPECT_THROW((void)FitTip(Box({0.01, 0.01, 0}), Directions()), std::runtime_error);
}

}  // namespace fit_tip_test
}  // namespace regrasp::kinematics
