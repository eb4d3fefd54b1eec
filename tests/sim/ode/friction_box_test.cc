#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "sim/ode/ode_world.h"

namespace regrasp::sim {
namespace friction_box_test {

using Eigen::Vector3d;

constexpr double kMu = 0.4;
constexpr double kSlack = 1e-9;

/// Unit normal and a force, which is not always inside the cone.
struct Draw {
  Vector3d normal, force;

  explicit Draw(std::mt19937& random) {
    std::normal_distribution<double> number;
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    normal = vector().normalized();
    force = vector() + 2 * normal;
  }
};

TEST(BoxInCircle, ItsCornersLieOnTheCircleWhateverTheForce) {
  std::mt19937 random(3);
  int pressing = 0;
  for (int i = 0; i < 1000; ++i) {
    const Draw draw(random);
    const FrictionBox box = BoxInCircle(draw.normal, draw.force, kMu);
    const double limit = kMu * std::max(draw.force.dot(draw.normal), 0.0);
    EXPECT_NEAR(std::hypot(box.along, box.across), limit, 1e-12 * (1 + limit));
    EXPECT_GE(box.along, box.across - 1e-12);
    EXPECT_NEAR(box.direction.norm(), 1, 1e-12);
    EXPECT_NEAR(box.direction.dot(draw.normal), 0, 1e-12);
    pressing += limit > 0 ? 1 : 0;
  }
  EXPECT_GT(pressing, 500);
}

TEST(BoxInCircle, IsASquareWithoutFrictionAndALineOfNearlyAllFrictionOnTheCircle) {
  const Vector3d n = Vector3d::UnitZ();
  const FrictionBox square = BoxInCircle(n, n, kMu);
  EXPECT_NEAR(square.along, square.across, 1e-12);
  const FrictionBox line = BoxInCircle(n, n + kMu * Vector3d::UnitX(), kMu);
  EXPECT_NEAR(line.along, kLongest * kMu, 1e-12);
  EXPECT_NEAR(std::abs(line.direction.x()), 1, 1e-12);
}

TEST(BoxInCircle, AContactThatPullsHasNoFriction) {
  const FrictionBox box = BoxInCircle(Vector3d::UnitZ(), {0.3, 0, -1}, kMu);
  EXPECT_EQ(box.along, 0);
  EXPECT_EQ(box.across, 0);
}

TEST(BoxInPlane, BoundsFrictionInThePlaneAlone) {
  const FrictionBox box = BoxInPlane(Vector3d::UnitX(), {2, 0.5, 0}, kMu);
  EXPECT_NEAR(std::abs(box.direction.y()), 1, 1e-12);
  EXPECT_NEAR(box.along, 2 * kMu, 1e-12);
  EXPECT_EQ(box.across, 0);
}

TEST(KeepsCone, LetsForcesInsidePassAndThoseOutsideNot) {
  const Vector3d n = Vector3d::UnitZ();
  const FrictionBox box = BoxInCircle(n, n, kMu);
  EXPECT_TRUE(KeepsCone(n, box, {0.1, 0.1, 1}, kMu, kSlack));
  // The same force violates the cone if the normal force is smaller than that of the box.
  EXPECT_FALSE(KeepsCone(n, box, {0.1, 0.1, 0.3}, kMu, kSlack));
}

TEST(KeepsCone, AForceThatTheBoxHeldBackInsideTheConeIsNotCoulombs) {
  const Vector3d n = Vector3d::UnitZ();
  const FrictionBox box = BoxInCircle(n, n, kMu);
  const Vector3d at_side = n + box.along * box.direction;
  EXPECT_FALSE(KeepsCone(n, box, at_side, kMu, kSlack));
  const Vector3d at_corner = at_side + box.across * n.cross(box.direction);
  EXPECT_TRUE(KeepsCone(n, box, at_corner, kMu, kSlack));
}

}  // namespace friction_box_test
}  // namespace regrasp::sim
