#include "render/frames/body_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/object/polygon.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace {

using Eigen::Vector3d;

double Volume(const FacetMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) volume += a.dot(b.cross(c)) / 6;
  return volume;
}

TEST(BodyShapeTest, IsTheRealSolidInUnitsOfItsDiameter) {
  const object::Polyhedron block = MakeThinLBlock();
  const BodyShape shape = MakeBodyShape(block);
  const double unit = std::pow(block.diameter(), 3);
  EXPECT_NEAR(Volume(shape.surface) * unit, block.mass_properties().volume, 1e-12);
  EXPECT_EQ(shape.edges.size(), 18U);  // of a prism of six sides; no edge inside a face
}

TEST(BodyShapeTest, TurnedInsideOutHasTheOppositeVolumeAndNormals) {
  const FacetMesh cube = MakeBodyShape(MakeCube(0.03)).surface;
  const FacetMesh turned = TurnInsideOut(cube);
  EXPECT_DOUBLE_EQ(Volume(turned), -Volume(cube));
  EXPECT_EQ(turned.normals[0][0], -cube.normals[0][0]);
}

TEST(BodyShapeTest, APolygonWithAHoleBecomesAClosedPrism) {
  const object::Polygon polygon = object::Polygon::FromWkt(
      "POLYGON((0 0, 3 0, 3 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 1))", "polygon");
  const BodyShape shape = MakeBodyShape(polygon);
  // Diameter 5, thickness a quarter of it: area (12 − 0.5) / 25 times 0.25.
  EXPECT_NEAR(Volume(shape.surface), 11.5 / 25 * 0.25, 1e-12);
  Vector3d flux = Vector3d::Zero();
  for (const auto& [a, b, c] : shape.surface.triangles) flux += (b - a).cross(c - a);
  EXPECT_LT(flux.norm(), 1e-12);
}

TEST(BodyShapeTest, APrismHasTheThicknessAskedForAndItsTopAtThePlaneOfTheContacts) {
  const object::Polygon square =
      object::Polygon::FromWkt("POLYGON((0 0, 3 0, 3 4, 0 4, 0 0))", "rectangle");
  for (const double thickness : {0.02, 0.25, 2.0}) {
    double low = 0, high = -1;
    for (const auto& corners : MakeBodyShape(square, thickness).surface.triangles) {
      for (const Vector3d& p : corners) {
        low = std::min(low, p.z());
        high = std::max(high, p.z());
      }
    }
    EXPECT_NEAR(high - low, thickness, 1e-12);
    EXPECT_GT(high, 0);
    EXPECT_LT(high, 0.01);
  }
}

TEST(BodyShapeTest, RaysInThePlaneOfTheContactsMeetThePrismsWalls) {
  const object::Polygon frame = object::Polygon::FromWkt(
      "POLYGON((-2 -2, 2 -2, 2 2, -2 2, -2 -2), (-1 -1, -1 1, 1 1, 1 -1, -1 -1))", "frame");
  const BodyShape shape = MakeBodyShape(frame);
  const double half = 1 / frame.diameter();
  int met = 0;
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0)}) {
    EXPECT_NEAR(RayDistance(shape.surface, -half * direction, direction, 1e-4), 2 * half, 1e-12);
    ++met;
  }
  EXPECT_EQ(met, 3);
}

TEST(BodyShapeTest, AWedgeIsAClosedPlateOfItsHalfAngle) {
  const double half_angle = Radians(25), slant = 0.15;
  const FacetMesh wedge = MakeWedge(half_angle, slant);
  Vector3d flux = Vector3d::Zero();
  double low = 1, high = 0;
  for (const auto& corners : wedge.triangles) {
    const auto& [a, b, c] = corners;
    flux += (b - a).cross(c - a);
    for (const Vector3d& p : corners) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
      if (p.z() == 0) continue;
      EXPECT_NEAR(std::atan2(std::abs(p.x()), p.z()), half_angle, 1e-12);
      EXPECT_NEAR(std::hypot(p.x(), p.z()), slant, 1e-12);
    }
  }
  EXPECT_LT(flux.norm(), 1e-15);
  const double area = slant * slant * std::sin(half_angle) * std::cos(half_angle);
  EXPECT_GT(low, 0);
  EXPECT_NEAR(Volume(wedge), area * (high - low), 1e-15);
}

TEST(BodyShapeTest, AConeHasItsHalfAngleAndOpensUpwards) {
  const double half_angle = Radians(25);
  const FacetMesh cone = MakeCone(half_angle, 2);
  int rim = 0;
  for (const auto& corners : cone.triangles) {
    for (const Vector3d& p : corners) {
      if (p.head<2>().norm() == 0) continue;
      EXPECT_NEAR(p.norm(), 2, 1e-12);
      EXPECT_NEAR(std::atan2(p.head<2>().norm(), p.z()), half_angle, 1e-12);
      ++rim;
    }
  }
  EXPECT_GT(rim, 100);
  EXPECT_GT(Volume(cone), 0);
}

TEST(BodyShapeTest, RaysMeetTheNearestTriangleBeyondTheSkip) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  const Vector3d x = Vector3d::UnitX();
  const Vector3d off_diagonal(0, 0.01, 0.02);
  EXPECT_NEAR(RayDistance(cube.surface, off_diagonal, x, 1e-4), half, 1e-12);
  EXPECT_NEAR(RayDistance(cube.surface, off_diagonal - half * x, x, 1e-4), 2 * half, 1e-12);
  EXPECT_TRUE(std::isinf(RayDistance(cube.surface, off_diagonal + x, x, 1e-4)));
}

}  // namespace
}  // namespace regrasp::render
