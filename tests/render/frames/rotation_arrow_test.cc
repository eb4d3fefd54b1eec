#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "render/frames/body_shape.h"
#include "render/frames/step_scene.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace rotation_arrow_test {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

const Vector3d kToEye = Vector3d(1, -1, 0.6).normalized();

std::vector<Vector3d> ArrowOf(double degrees, const Vector3d& axis) {
  static const BodyShape cube = MakeBodyShape(MakeCube());
  const Isometry3d before(AngleAxisd(0.3, Vector3d::UnitX()));
  const Isometry3d after = AngleAxisd(Radians(degrees), axis) * before;
  return RotationArrow(cube.surface, before, after, kToEye);
}

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(RotationArrow, HasTheAngleAndTheSenseOfTheRotation) {
  int checked = 0;
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0.6, 0, 0.8)}) {
    for (const double degrees : {30.0, 60.0, 150.0}) {
      const std::vector<Vector3d> arrow = ArrowOf(degrees, axis);
      ASSERT_GE(arrow.size(), 2u);
      const auto across = [&](const Vector3d& p) -> Vector3d { return p - p.dot(axis) * axis; };
      const Vector3d from = across(arrow.front());
      const Vector3d to = across(arrow.back());
      EXPECT_NEAR(Degrees(AngleBetween(from, to)), degrees, 1e-6);
      EXPECT_GT(from.cross(to).dot(axis), 0);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 9);
}

TEST(RotationArrow, IsAboveTheObjectOnTheSideOfTheEye) {
  for (const double sign : {1.0, -1.0}) {
    for (const Vector3d& p : ArrowOf(40, sign * Vector3d::UnitZ())) {
      EXPECT_GT(p.z(), 0.5 / std::sqrt(3)) << "a cube of diameter 1";
    }
  }
  const std::vector<Vector3d> arrow = ArrowOf(40, Vector3d::UnitZ());
  EXPECT_GT(arrow[arrow.size() / 2].dot(kToEye), 0.3);
}

TEST(RotationArrow, ShowsTheSenseOfASmallRotationByALongerArc) {
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Vector3d> arrow = ArrowOf(5, sign * Vector3d::UnitZ());
    ASSERT_GE(arrow.size(), 3u);
    const Vector3d from = {arrow.front().x(), arrow.front().y(), 0};
    const Vector3d to = {arrow.back().x(), arrow.back().y(), 0};
    EXPECT_NEAR(Degrees(AngleBetween(from, to)), 30, 1e-6);
    EXPECT_GT(sign * from.cross(to).z(), 0);
  }
}

TEST(RotationArrow, IsOmittedForSmallRotations) {
  EXPECT_TRUE(ArrowOf(0, Vector3d::UnitZ()).empty());
  EXPECT_TRUE(ArrowOf(1, Vector3d::UnitZ()).empty());
}

}  // namespace rotation_arrow_test
}  // namespace regrasp::render
