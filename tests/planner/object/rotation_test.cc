#include "planner/object/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace regrasp::object {
namespace rotation_test {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const Matrix3d kFrom = AngleAxisd(0.7, Vector3d(1, -2, 3).normalized()).toRotationMatrix();
const Matrix3d kTo = AngleAxisd(1.9, Vector3d(2, 1, 1).normalized()).toRotationMatrix();

TEST(Rotation, TakesOneOrientationToTheOther) {
  EXPECT_TRUE((kFrom * RotationInBody(kFrom, kTo).toRotationMatrix()).isApprox(kTo, 1e-12));
  EXPECT_TRUE((RotationInWorld(kFrom, kTo).toRotationMatrix() * kFrom).isApprox(kTo, 1e-12));
}

TEST(Rotation, HasTheSameAngleInBothFrames) {
  const AngleAxisd body = RotationInBody(kFrom, kTo);
  const AngleAxisd world = RotationInWorld(kFrom, kTo);
  EXPECT_NEAR(body.angle(), world.angle(), 1e-12);
  EXPECT_TRUE((kFrom * body.axis()).isApprox(world.axis(), 1e-12));
  // The frames matter: the axes differ in these orientations.
  EXPECT_FALSE(body.axis().isApprox(world.axis(), 1e-3));
}

TEST(Rotation, OfEqualOrientationsIsZero) {
  EXPECT_NEAR(RotationInBody(kFrom, kFrom).angle(), 0, 1e-7);
}

TEST(Rotation, AlignsDirections) {
  const Vector3d from(1, 2, -3), to(-2, 0.5, 4);
  EXPECT_TRUE((AligningRotation(from, to) * from.normalized()).isApprox(to.normalized(), 1e-12));
  const Eigen::Quaterniond back = AligningRotation(from, -from);
  EXPECT_TRUE((back * from).isApprox(-from, 1e-9));
  EXPECT_NEAR(AngleAxisd(back).angle(), std::numbers::pi, 1e-7);
}

TEST(Rotation, APoseBetweenTwoMovesAtConstantRate) {
  Eigen::Isometry3d from = Eigen::Isometry3d::Identity(), to = from;
  from.linear() = kFrom;
  to.linear() = kTo;
  from.translation() = Vector3d(1, 2, 3);
  to.translation() = Vector3d(3, -2, 3);
  EXPECT_TRUE(PoseBetween(from, to, 0).isApprox(from, 1e-12));
  EXPECT_TRUE(PoseBetween(from, to, 1).isApprox(to, 1e-12));
  const Eigen::Isometry3d between = PoseBetween(from, to, 0.25);
  EXPECT_TRUE(between.translation().isApprox(Vector3d(1.5, 1, 3), 1e-12));
  const AngleAxisd whole = RotationInBody(kFrom, kTo);
  const AngleAxisd part = RotationInBody(kFrom, between.linear());
  EXPECT_NEAR(part.angle(), 0.25 * whole.angle(), 1e-12);
  EXPECT_TRUE(part.axis().isApprox(whole.axis(), 1e-9));
}

}  // namespace rotation_test
}  // namespace regrasp::object
