#include "planner/plan/projection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace surface_tolerance_test {

constexpr double kHalf = 0.03;

/// Return the reason why a point is not on the cube's face towards +x, selected by its normal.
Reason ReasonOf(const object::Object& cube, const Eigen::Vector3d& point) {
  return ProjectContact(cube, {point, -Eigen::Vector3d::UnitX()}).reason;
}

double InSinglePrecision(double value) {
  volatile float single = static_cast<float>(value);
  return static_cast<double>(single);
}

TEST(SurfaceTolerance, PointsInSinglePrecisionAreOnAnObjectFarFromTheOrigin) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> across(-0.9 * kHalf, 0.9 * kHalf);
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(-3, 2.5, 1), Eigen::Vector3d(40, 0, 7)}) {
    int moved = 0;
    for (int i = 0; i < 200; ++i) {
      // Each size has a different rounding error of its face.
      const double half = kHalf * (1 + 1e-3 * i);
      const object::Polyhedron cube = MakeCube(half, offset);
      const Eigen::Vector3d exact = offset + Eigen::Vector3d(half, across(engine), across(engine));
      const Eigen::Vector3d single = exact.unaryExpr(&InSinglePrecision);
      EXPECT_EQ(ReasonOf(cube, single), Reason::kNone) << offset.transpose();
      moved += std::abs(single.x() - exact.x()) > 1e-6 * cube.diameter() ? 1 : 0;
    }
    // Positive control: some points are farther off than the tolerance of an object at the origin.
    EXPECT_GT(moved, 0) << offset.transpose();
    EXPECT_EQ(ReasonOf(MakeCube(kHalf, offset), offset + Eigen::Vector3d(kHalf + 1e-4, 0, 0)),
              Reason::kOffSurface);
  }
}

TEST(SurfaceTolerance, NearTheOriginItIsAMillionthOfTheDiameter) {
  for (const double offset : {0.0, kHalf, 2 * kHalf}) {
    const object::Polyhedron cube = MakeCube(kHalf, {offset, 0, 0});
    EXPECT_EQ(SurfaceTolerance(cube), object::kPointTolerance * cube.diameter()) << offset;
  }
  EXPECT_GT(SurfaceTolerance(MakeCube(kHalf, {5 * kHalf, 0, 0})),
            object::kPointTolerance * MakeCube(kHalf).diameter());
}

TEST(SurfaceTolerance, IsNeverMoreThanAThousandthOfTheDiameter) {
  const object::Polyhedron cube = MakeCube(kHalf, {1e4, 0, 0});
  EXPECT_DOUBLE_EQ(SurfaceTolerance(cube), 1e-3 * cube.diameter());
}

TEST(SurfaceTolerance, TheTextHasTheDistanceAndTheTolerance) {
  EXPECT_EQ(OffSurfaceText(MakeCube(), {1.001, 0, 0}),
            "off the surface, expected at most 0.0001 % of the object's diameter, found 0.02887 % "
            "(0.001 in "
            "the object file's unit)");
  const std::string far = OffSurfaceText(MakeCube(kHalf, {3, 0, 0}), {3.04, 0, 0});
  EXPECT_THAT(far, testing::HasSubstr("(0.01 in the object file's unit)"));
  EXPECT_THAT(far, testing::StartsWith("off the surface, expected at most 0.001424 % of"));
  EXPECT_THAT(far, testing::HasSubstr("float32"));
}

}  // namespace surface_tolerance_test
}  // namespace regrasp::plan
