#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "sim/ode/ode_world.h"

namespace regrasp::sim {
namespace patch_touch_test {

using Eigen::Vector3d;

constexpr double kThickness = 0.5;

/// Return a rectangle of 2 by 1 in the plane z = 0, about the origin, seen from above.
ContactPatch Rectangle() {
  return {{{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}, true};
}

PatchPrism Prism() { return MakePrism(Rectangle(), -Vector3d::UnitZ(), kThickness); }

TEST(TouchPatch, ABallAboveTheFaceTouchesStraightBelowItsCentre) {
  const auto touch = TouchPatch(Prism(), {0.3, 0.2, 0.09}, 0.1);
  ASSERT_TRUE(touch);
  EXPECT_TRUE(touch->point.isApprox(Vector3d(0.3, 0.2, 0), 1e-12));
  EXPECT_TRUE(touch->normal.isApprox(-Vector3d::UnitZ(), 1e-12));
  EXPECT_NEAR(touch->depth, 0.01, 1e-12);
}

TEST(TouchPatch, ABallThatIsAsFarAsItsRadiusDoesNotTouch) {
  EXPECT_FALSE(TouchPatch(Prism(), {0, 0, 0.1}, 0.1));
  EXPECT_TRUE(TouchPatch(Prism(), {0, 0, 0.1 - 1e-12}, 0.1));
  EXPECT_FALSE(TouchPatch(Prism(), {1.1, 0, 0}, 0.1));
}

TEST(TouchPatch, BeyondTheFaceARimIsTouched) {
  const auto touch = TouchPatch(Prism(), {1.03, 0, 0.04}, 0.1);
  ASSERT_TRUE(touch);
  EXPECT_TRUE(touch->point.isApprox(Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(touch->normal.isApprox(Vector3d(-0.6, 0, -0.8), 1e-12));
  EXPECT_NEAR(touch->depth, 0.05, 1e-12);
  // Below the edge, the side face is nearest.
  const auto side = TouchPatch(Prism(), {1.03, 0, -0.2}, 0.1);
  ASSERT_TRUE(side);
  EXPECT_TRUE(side->normal.isApprox(-Vector3d::UnitX(), 1e-12));
}

TEST(TouchPatch, ATipUnderTheFaceIsPushedOutOfItAndOneBelowThePrismIsNot) {
  const auto touch = TouchPatch(Prism(), {0, 0, -0.01}, 0.1);
  ASSERT_TRUE(touch);
  EXPECT_TRUE(touch->normal.isApprox(-Vector3d::UnitZ(), 1e-12));
  EXPECT_NEAR(touch->depth, 0.11, 1e-12);
  EXPECT_FALSE(TouchPatch(Prism(), {0, 0, -kThickness - 1e-9}, 0.1));
}

TEST(TouchPatch, MovesWithThePatch) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  int touched = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::AngleAxisd turn(3 * unit(random), draw().normalized());
    const Eigen::Isometry3d X = Eigen::Translation3d(draw()) * turn;
    ContactPatch moved = Rectangle();
    for (Vector3d& corner : moved.outline) corner = X * corner;
    const Vector3d centre = Vector3d(1.5, 1, 0.5).cwiseProduct(draw());
    const auto here = TouchPatch(Prism(), centre, 0.3);
    const auto there =
        TouchPatch(MakePrism(moved, turn * -Vector3d::UnitZ(), kThickness), X * centre, 0.3);
    ASSERT_EQ(here.has_value(), there.has_value()) << i;
    if (!here) continue;
    EXPECT_LT((X * here->point - there->point).norm(), 1e-9);
    EXPECT_LT((turn * here->normal - there->normal).norm(), 1e-9);
    EXPECT_NEAR(here->depth, there->depth, 1e-9);
    ++touched;
  }
  EXPECT_GT(touched, 100);
}

}  // namespace patch_touch_test
}  // namespace regrasp::sim
