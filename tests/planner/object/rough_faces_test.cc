#include "planner/object/rough_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/object/polyhedron.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace {

using Eigen::Vector3d;
using namespace regrasp::testing;  // NOLINT: the meshes of objects

constexpr double kDegree = std::numbers::pi / 180;

/// A sphere of radius 1 whose vertices are drawn out and pushed in by turns.
PolygonSoup RoughSphere(double noise) {
  PolygonSoup sphere = SphereSoup(30);
  for (std::size_t v = 0; v < sphere.vertices.size(); ++v) {
    sphere.vertices[v] *= 1 + noise * std::sin(12.9898 * double(v) * double(v));
  }
  return sphere;
}

Polyhedron Read(const PolygonSoup& soup, std::optional<double> radius, double degrees) {
  Reading reading;
  reading.patch = FeltPatch{radius, degrees * kDegree};
  return Polyhedron::FromSoup(soup, "soup", reading);
}

std::vector<bool> RoughOf(const Polyhedron& body) {
  std::vector<bool> rough;
  for (FaceIndex f{0}; f < body.face_count(); ++f) rough.push_back(body.IsRough(f));
  return rough;
}

auto CountRough(const Polyhedron& body) { return std::ranges::count(RoughOf(body), true); }

TEST(RoughFaces, WideFacesAreNeverRough) {
  EXPECT_EQ(CountRough(Read(UnitCubeSoup(), 0.5, 1)), 0);
  EXPECT_EQ(CountRough(Read(LBlockSoup(), 0.3, 1)), 0);
}

TEST(RoughFaces, ASmoothSurfaceHasNoneAndANoisyOneHasSome) {
  EXPECT_EQ(CountRough(Read(SphereSoup(30), 0.2, 5)), 0);
  const Polyhedron noisy = Read(RoughSphere(0.01), 0.2, 5);
  EXPECT_GT(CountRough(noisy), noisy.face_count() / 10);
  EXPECT_LT(CountRough(noisy), noisy.face_count());
}

TEST(RoughFaces, WithoutAPatchNoFaceIsRough) {
  const Polyhedron noisy = Polyhedron::FromSoup(RoughSphere(0.01), "soup");
  EXPECT_EQ(CountRough(noisy), 0);
  EXPECT_TRUE(noisy.TakesFingers(FaceIndex(0)));
}

TEST(RoughFaces, ARoughFaceTakesNoFingers) {
  const Polyhedron noisy = Read(RoughSphere(0.01), 0.2, 5);
  for (FaceIndex f{0}; f < noisy.face_count(); ++f) {
    EXPECT_EQ(noisy.TakesFingers(f), !noisy.IsRough(f));
  }
}

TEST(RoughFaces, MoreAreAllowedByALargerAngle) {
  const std::vector<bool> strict = RoughOf(Read(RoughSphere(0.01), 0.2, 4));
  const std::vector<bool> lenient = RoughOf(Read(RoughSphere(0.01), 0.2, 8));
  for (std::size_t f = 0; f < strict.size(); ++f) EXPECT_TRUE(strict[f] || !lenient[f]);
  EXPECT_LT(std::ranges::count(lenient, true), std::ranges::count(strict, true));
}

TEST(RoughFaces, MovesAndScalesWithTheObject) {
  const PolygonSoup sphere = RoughSphere(0.01);
  PolygonSoup moved = sphere;
  Transform(moved, SomeMotion() * Eigen::Scaling(100.0));
  EXPECT_EQ(RoughOf(Read(moved, 20, 5)), RoughOf(Read(sphere, 0.2, 5)));
  EXPECT_EQ(RoughOf(Read(moved, std::nullopt, 5)), RoughOf(Read(sphere, std::nullopt, 5)));
}

TEST(RoughFaces, TheOtherSideOfAThinWallDoesNotCount) {
  // A grid on both sides of a plate thinner than the patch: with the far side the mean would be 0.
  const Polyhedron plate = Read(SphereSoup(30), 2.5, 5);
  EXPECT_GT(CountRough(plate), 0);  // control: a patch as large as the sphere
  PolygonSoup thin = SphereSoup(30);
  Transform(thin, Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 0.001)));
  const Polyhedron disc = Read(thin, 0.1, 5);
  int flat = 0;
  for (FaceIndex f{0}; f < disc.face_count(); ++f) {
    if (disc.CentroidOf(f).head<2>().norm() > 0.8) continue;
    ++flat;
    EXPECT_FALSE(disc.IsRough(f));
  }
  EXPECT_GT(flat, 100);
}

}  // namespace
}  // namespace regrasp::object
