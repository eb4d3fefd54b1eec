#include "planner/gait/rolling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace rolling_test {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kRadius = 0.01;
constexpr int kSteps = 90;

class RollingTest : public testing::Test {
 protected:
  object::ObjectFile file_ = object::ReadObject(ProjectPath("models/cube.obj"));
  collision::BallContact cube_{dynamic_cast<const object::Polyhedron&>(*file_.object), 1};  // 6 cm

  [[nodiscard]] SurfacePoint RolledBy(SurfacePoint contact, double angle, const Vector3d& axis) {
    const Eigen::Matrix3d turn = AngleAxisd(angle / kSteps, axis).toRotationMatrix();
    for (int i = 0; i < kSteps; ++i) contact = Rolled(contact, turn, kRadius, cube_);
    return contact;
  }
};

const SurfacePoint kOnTop = {{-0.01, 0.002, 0.03}, -Vector3d::UnitZ()};

TEST_F(RollingTest, OnAPlaneTheContactMovesByRadiusTimesAngle) {
  // A wheel on the ground that rotates about +y moves towards +x.
  const SurfacePoint rolled = RolledBy(kOnTop, Radians(90), Vector3d::UnitY());
  EXPECT_LT((rolled.p - kOnTop.p - Vector3d(kRadius * Radians(90), 0, 0)).norm(), 1e-12);
  EXPECT_LT((rolled.n - kOnTop.n).norm(), 1e-12);
}

TEST_F(RollingTest, SpinAboutTheNormalDoesNotMoveTheContact) {
  const SurfacePoint rolled = RolledBy(kOnTop, Radians(90), Vector3d::UnitZ());
  EXPECT_LT((rolled.p - kOnTop.p).norm(), 1e-12);
}

TEST_F(RollingTest, TheContactRollsOverAnEdgeToTheNextFace) {
  const double to_edge = 0.04 / kRadius;
  const SurfacePoint on_edge = RolledBy(kOnTop, to_edge + Radians(45), Vector3d::UnitY());
  EXPECT_LT((on_edge.p - Vector3d(0.03, 0.002, 0.03)).norm(), 1e-9);
  EXPECT_NEAR(Degrees(std::acos(-on_edge.n.z())), 45, 2);
  const SurfacePoint beyond = RolledBy(kOnTop, to_edge + Radians(90) + 1, Vector3d::UnitY());
  EXPECT_LT((beyond.n + Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_NEAR(beyond.p.z(), 0.03 - kRadius, 5e-4);
}

TEST_F(RollingTest, RollingIsReversible) {
  const Vector3d axis = Vector3d(1, 2, 0).normalized();
  const SurfacePoint back = RolledBy(RolledBy(kOnTop, 1, axis), -1, axis);
  EXPECT_LT((back.p - kOnTop.p).norm(), 1e-12);
}

TEST_F(RollingTest, WithoutANearbySurfaceTheContactStays) {
  const SurfacePoint away = {{0, 0, 0.2}, -Vector3d::UnitZ()};
  EXPECT_EQ(Rolled(away, AngleAxisd(0.1, Vector3d::UnitX()).toRotationMatrix(), kRadius, cube_).p,
            away.p);
}

}  // namespace rolling_test
}  // namespace regrasp::gait
