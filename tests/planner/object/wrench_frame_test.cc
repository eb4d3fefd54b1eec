#include "planner/object/wrench_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "planner/object/body_measures.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace mass_properties_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace regrasp::soups;  // NOLINT: the meshes of this folder

constexpr double kTight = 1e-12;

MassProperties MassOf(const PolygonSoup& soup) {
  return Polyhedron::FromSoup(soup, "body").mass_properties();
}

Matrix3d BoxInertia(double a, double b, double c) {
  const double m = a * b * c / 12;
  return Vector3d(m * (b * b + c * c), m * (a * a + c * c), m * (a * a + b * b)).asDiagonal();
}

TEST(MassProperties, OfABoxAreTheClosedForm) {
  const MassProperties mass = MassOf(BoxSoup({1, 2, 3}, {2, 4, 7}));
  EXPECT_NEAR(mass.volume, 8, kTight);
  EXPECT_NEAR((mass.centroid - Vector3d(1.5, 3, 5)).norm(), 0, kTight);
  EXPECT_NEAR((mass.inertia - BoxInertia(1, 2, 4)).norm(), 0, 1e-11);
}

TEST(MassProperties, OfACornerTetrahedronAreTheClosedForm) {
  // Over the tetrahedron, ∫x² = 1/60 and ∫xy = 1/120. The centroid is at 1/4, the volume is 1/6.
  const MassProperties mass = MassOf(CornerTetrahedronSoup());
  EXPECT_NEAR(mass.volume, 1 / 6.0, kTight);
  EXPECT_NEAR((mass.centroid - Vector3d::Constant(0.25)).norm(), 0, kTight);
  const double square = 1 / 60.0 - 1 / 96.0, product = 1 / 120.0 - 1 / 96.0;
  Matrix3d inertia = Matrix3d::Constant(-product);
  inertia.diagonal().setConstant(2 * square);
  EXPECT_NEAR((mass.inertia - inertia).norm(), 0, kTight);
}

TEST(MassProperties, OfABlockWithAHoleAreTheDifferenceOfTwoBoxes) {
  const MassProperties mass = MassOf(HoleBlockSoup());
  EXPECT_NEAR(mass.volume, 8, kTight);
  EXPECT_NEAR((mass.centroid - Vector3d(1.5, 1.5, 0.5)).norm(), 0, kTight);
  EXPECT_NEAR((mass.inertia - BoxInertia(3, 3, 1) + BoxInertia(1, 1, 1)).norm(), 0, 1e-11);
}

TEST(MassProperties, MoveTurnAndScaleWithTheBody) {
  int bodies = 0;
  for (PolygonSoup soup :
       {UnitCubeSoup(), LBlockSoup(), HoleBlockSoup(), CornerTetrahedronSoup()}) {
    const MassProperties before = MassOf(soup);
    const Eigen::Affine3d motion = SomeMotion();
    constexpr double kScale = 1.7;
    Transform(soup, motion * Eigen::Scaling(kScale));
    const MassProperties after = MassOf(soup);
    const Matrix3d r = motion.linear();
    EXPECT_NEAR(after.volume, std::pow(kScale, 3) * before.volume, 1e-11);
    EXPECT_NEAR((after.centroid - motion * (kScale * before.centroid)).norm(), 0, 1e-11);
    const Matrix3d inertia = std::pow(kScale, 5) * r * before.inertia * r.transpose();
    EXPECT_NEAR((after.inertia - inertia).norm(), 0, 1e-9);
    ++bodies;
  }
  EXPECT_EQ(bodies, 4);
}

TEST(MassProperties, OfABodyFarFromTheOriginKeepTheirDigits) {
  PolygonSoup soup = UnitCubeSoup();
  Transform(soup, Eigen::Affine3d(Eigen::Translation3d(1e6, -1e6, 1e6)));
  const MassProperties mass = MassOf(soup);
  EXPECT_NEAR(mass.volume, 1, 1e-9);
  EXPECT_NEAR((mass.inertia - BoxInertia(1, 1, 1)).norm(), 0, 1e-8);
}

TEST(MassProperties, TurnedInwardTheyAreNotPositive) {
  const Polyhedron cube = Polyhedron::FromSoup(UnitCubeSoup(), "cube");
  auto triangles = cube.triangles();
  for (auto& t : triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(ComputeMassProperties(cube.vertices(), triangles).volume, -1, kTight);
}

TEST(Diameter, IsTheLargestDistanceOfAllPairs) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const int count : {2, 3, 50, 255, 256, 257, 400, 3000}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back({normal(random), 3 * normal(random), 0});
    double largest = 0;
    for (const auto& p : points) {
      for (const auto& q : points) largest = std::max(largest, (p - q).norm());
    }
    EXPECT_DOUBLE_EQ(ComputeDiameter(points), largest) << count;
  }
  // Round, elongated, and far from the origin: nearly all or nearly no points can be ends.
  for (const double stretch : {1.0, 1.01, 5.0}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d direction(normal(random), normal(random), normal(random));
      points.push_back(direction.normalized());
      points.back().x() = 100 + stretch * points.back().x();
    }
    double largest = 0;
    for (const auto& p : points) {
      for (const auto& q : points) largest = std::max(largest, (p - q).norm());
    }
    EXPECT_DOUBLE_EQ(ComputeDiameter(points), largest) << stretch;
  }
  EXPECT_EQ(ComputeDiameter(std::vector<Vector3d>{}), 0);
  EXPECT_EQ(ComputeDiameter(std::vector<Vector3d>{{1, 2, 3}}), 0);
  EXPECT_EQ(ComputeDiameter(std::vector<Vector3d>(1000, Vector3d(1, 2, 3))), 0);
}

}  // namespace mass_properties_test
}  // namespace regrasp::object
