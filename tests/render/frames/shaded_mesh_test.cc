#include "render/frames/shaded_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "render/frames/body_shape.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace shaded_mesh_test {

using Eigen::Vector3d;

TEST(ShadedMeshTest, InvertedMeshesHaveTheOppositeVolumeAndNormals) {
  const ShadedMesh cube = MakeBodyShape(MakeCube(0.03)).surface;
  const ShadedMesh turned = TurnInsideOut(cube);
  EXPECT_DOUBLE_EQ(Volume(turned), -Volume(cube));
  EXPECT_EQ(turned.normals[0][0], -cube.normals[0][0]);
}

TEST(ShadedMeshTest, AWedgeIsAClosedPlateOfItsFrictionAngle) {
  const double friction_angle = Radians(25), slant = 0.15;
  const ShadedMesh wedge = MakeWedge(friction_angle, slant);
  Vector3d flux = Vector3d::Zero();
  double low = 1, high = 0;
  for (const auto& corners : wedge.triangles) {
    const auto& [a, b, c] = corners;
    flux += (b - a).cross(c - a);
    for (const Vector3d& p : corners) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
      if (p.z() == 0) continue;
      EXPECT_NEAR(std::atan2(std::abs(p.x()), p.z()), friction_angle, 1e-12);
      EXPECT_NEAR(std::hypot(p.x(), p.z()), slant, 1e-12);
    }
  }
  EXPECT_LT(flux.norm(), 1e-15);
  const double area = slant * slant * std::sin(friction_angle) * std::cos(friction_angle);
  EXPECT_GT(low, 0);
  EXPECT_NEAR(Volume(wedge), area * (high - low), 1e-15);
}

TEST(ShadedMeshTest, AConeHasItsFrictionAngleAndOpensUpwards) {
  const double friction_angle = Radians(25);
  const ShadedMesh cone = MakeCone(friction_angle, 2);
  int rim = 0;
  for (const auto& corners : cone.triangles) {
    for (const Vector3d& p : corners) {
      if (p.head<2>().norm() == 0) continue;
      EXPECT_NEAR(p.norm(), 2, 1e-12);
      EXPECT_NEAR(std::atan2(p.head<2>().norm(), p.z()), friction_angle, 1e-12);
      ++rim;
    }
  }
  EXPECT_GT(rim, 100);
  EXPECT_GT(Volume(cone), 0);
}

TEST(ShadedMeshTest, ACapsuleHasTheVolumeOfACylinderAndASphere) {
  const Vector3d from(0.2, -0.1, 0.4), to(0.5, 0.3, -0.2);
  const double radius = 0.1;
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  const double cylinder = std::numbers::pi * radius * radius * (to - from).norm();
  // Triangles lie inside the capsule, so that the volume is slightly smaller.
  for (const Vector3d& end : {to, from}) {
    const double wanted = end == to ? ball + cylinder : ball;
    const double volume = Volume(MakeCapsule(from, end, radius));
    EXPECT_LT(volume, wanted);
    EXPECT_GT(volume, 0.97 * wanted);
  }
}

TEST(ShadedMeshTest, NormalsOfACapsuleLeaveItsAxis) {
  const Vector3d from(0, 0, 0), to(0, 0, 1);
  const ShadedMesh capsule = MakeCapsule(from, to, 0.1);
  for (std::size_t i = 0; i < capsule.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3d& p = capsule.triangles[i][corner];
      const Vector3d axis(0, 0, std::clamp(p.z(), 0.0, 1.0));
      EXPECT_LT((p - axis - 0.1 * capsule.normals[i][corner]).norm(), 1e-12);
    }
  }
}

TEST(ShadedMeshTest, ABandIsFlatAcrossTheLineOfSightAndAsWideAsItsCapsule) {
  const Vector3d back = Vector3d(1, 2, 3).normalized();
  const Vector3d from(0, 0, 0), to(1, 0, 0);
  const ShadedMesh band = MakeBand(from, to, 0.05, back);
  double widest = 0;
  for (const auto& corners : band.triangles) {
    const auto& [a, b, c] = corners;
    EXPECT_GE((b - a).cross(c - a).dot(back), 0);  // visible from the front
    for (const Vector3d& p : corners) {
      const Vector3d flat = p - 0.05 * back;
      const double along = std::clamp(flat.dot(to), 0.0, 1.0);
      const Vector3d off = flat - along * to;
      widest = std::max(widest, (off - off.dot(back) * back).norm());
    }
  }
  EXPECT_NEAR(widest, 0.05, 1e-12);
}

// Software rasterizers interpolate depth in long, narrow triangles with errors that let a surface
// show through.
TEST(ShadedMeshTest, TrianglesAlongABandHaveItsFullWidth) {
  const Vector3d back = Vector3d::UnitZ();
  const ShadedMesh band = MakeBand({0, 0, 0}, {1, 0, 0}, 0.05, back);
  int along = 0;
  for (const auto& corners : band.triangles) {
    const auto [left, right] =
        std::ranges::minmax(corners, {}, [](const auto& p) { return p.x(); });
    if (right.x() - left.x() < 0.2) continue;
    const auto [below, above] =
        std::ranges::minmax(corners, {}, [](const auto& p) { return p.y(); });
    EXPECT_NEAR(above.y() - below.y(), 0.1, 1e-12);
    ++along;
  }
  EXPECT_EQ(along, 2);
}

TEST(ShadedMeshTest, ABandAlongTheLineOfSightIsADisc) {
  const ShadedMesh band = MakeBand({0, 0, 0}, {0, 0, 1}, 0.05, Vector3d::UnitZ());
  for (const auto& corners : band.triangles) {
    for (const Vector3d& p : corners) EXPECT_NEAR(p.head<2>().norm(), 0.05, 1e-12);
  }
}

}  // namespace shaded_mesh_test
}  // namespace regrasp::render
