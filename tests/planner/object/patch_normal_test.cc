#include "planner/object/patch_normal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "planner/object/polyhedron.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace patch_normal_test {

using Eigen::Vector3d;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

constexpr double kPi = std::numbers::pi;

Polyhedron Solid(const PolygonSoup& soup) { return Polyhedron::FromSoup(soup, "soup"); }

/// Compute the patch normal at a surface point, on the face whose outward normal is nearest to
/// `outward`.
Vector3d NormalAt(const Polyhedron& solid, const Vector3d& point, const Vector3d& outward,
                  double radius) {
  FaceIndex best{0};
  for (const FaceIndex face : solid.FacesNear(point, 1e-9 * solid.diameter())) {
    if (solid.inward_normal(face).dot(outward) < solid.inward_normal(best).dot(outward))
      best = face;
  }
  return PatchNormal(solid, best, point, radius);
}

/// Compute the area of a circle beyond a chord at a distance from its centre.
double SegmentArea(double radius, double distance) {
  return radius * radius * std::acos(distance / radius) -
         distance * std::sqrt(radius * radius - distance * distance);
}

TEST(PatchNormal, AwayFromBordersIsTheFacesNormal) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  EXPECT_EQ(NormalAt(cube, {0.1, 0.2, 0.5}, {0, 0, 1}, 0.25), Vector3d(0, 0, -1));
}

TEST(PatchNormal, BesideAnEdgeIsTheMeanOfTwoPiecesOfDiscs) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  const double radius = 0.2;
  for (const double distance : {0.0, 0.05, 0.1, 0.19}) {
    const double own = kPi * radius * radius - SegmentArea(radius, distance);
    // Half of the disc in which the ball intersects the plane beyond the edge.
    const double beyond = kPi * (radius * radius - distance * distance) / 2;
    const Vector3d expected = -Vector3d(beyond, 0, own).normalized();
    const Vector3d mean = NormalAt(cube, {0.5 - distance, 0.1, 0.5}, {0, 0, 1}, radius);
    EXPECT_LT((mean - expected).norm(), 1e-12) << distance;
  }
}

TEST(PatchNormal, InACornerOfThreeFacesIsTheirMean) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  const Vector3d mean = NormalAt(cube, {0.5, 0.5, 0.5}, {0, 0, 1}, 0.3);
  EXPECT_LT((mean + Vector3d::Constant(1 / std::sqrt(3.0))).norm(), 1e-12);
}

TEST(PatchNormal, DoesNotDependOnHowFacesAreCut) {
  PolygonSoup fine = UnitCubeSoup();
  fine.vertices.push_back({0.3, 0.1, 0.5});
  const std::vector<int> top = fine.facets[1];
  fine.facets.erase(fine.facets.begin() + 1);
  for (int k = 0; k < 4; ++k) fine.facets.push_back({top[k], top[(k + 1) % 4], 8});
  for (const Vector3d& at : {Vector3d(0.45, 0.1, 0.5), {0.3, 0.1, 0.5}, {0.4, 0.4, 0.5}}) {
    const Vector3d coarse = NormalAt(Solid(UnitCubeSoup()), at, {0, 0, 1}, 0.4);
    EXPECT_LT((NormalAt(Solid(fine), at, {0, 0, 1}, 0.4) - coarse).norm(), 1e-12);
    EXPECT_GT((coarse - Vector3d(0, 0, -1)).norm(), 0.01);
  }
}

TEST(PatchNormal, MovesAndScalesWithTheObject) {
  const Eigen::Affine3d motion = SomeMotion() * Eigen::Scaling(100.0);
  PolygonSoup moved = SphereSoup(10);
  Transform(moved, motion);
  const Polyhedron sphere = Solid(SphereSoup(10)), far = Solid(moved);
  int checked = 0;
  for (FaceIndex f{0}; f < sphere.face_count(); f = FaceIndex(f + 7)) {
    const Vector3d at = sphere.CentroidOf(f);
    const Vector3d mean = PatchNormal(sphere, f, at, 0.4);
    EXPECT_LT((PatchNormal(far, f, motion * at, 40) - SomeMotion().linear() * mean).norm(), 1e-9);
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

TEST(PatchNormal, OfASphereIsTheRadius) {
  // Normals of triangles deviate by up to 6°; the mean over many of them does not.
  const Polyhedron sphere = Solid(SphereSoup(30));
  int tilted = 0;
  for (FaceIndex f{0}; f < sphere.face_count(); f = FaceIndex(f + 11)) {
    // The corner of the triangle farthest from the poles.
    const Vector3d at = sphere.BordersOf(f).front().a;
    const Vector3d mean = PatchNormal(sphere, f, at, 0.4);
    EXPECT_LT((mean + at.normalized()).norm(), 0.01);
    tilted += (sphere.inward_normal(f) + at.normalized()).norm() > 0.03;
  }
  EXPECT_GT(tilted, 10);
}

TEST(PatchNormal, TheFarSideOfAThinWallDoesNotCount) {
  const Polyhedron plate = Solid(BoxSoup({0, 0, 0}, {1, 1, 0.01}));
  EXPECT_EQ(NormalAt(plate, {0.5, 0.5, 0.01}, {0, 0, 1}, 0.4), Vector3d(0, 0, -1));
  // Control: near the rim, the far side is connected.
  EXPECT_GT(std::abs(NormalAt(plate, {0.99, 0.5, 0.01}, {0, 0, 1}, 0.4).x()), 0.1);
}

TEST(PatchNormal, WhatIsConnectedOnlyOutsideOfTheBallDoesNotCount) {
  // Two legs of a U: the inside of the other leg is close, but the path along the surface is long.
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0},
                               {1.1, 0.0},
                               {1.1, 2.0},
                               {0.6, 2.0},
                               {0.6, 0.5},
                               {0.5, 0.5},
                               {0.5, 2.0},
                               {0.0, 2.0}}) {
      soup.vertices.push_back({x, y, z});
    }
  }
  soup.facets = {{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    soup.facets.push_back({i, j, j + 8, i + 8});
  }
  const Polyhedron channel = Solid(soup);
  const Vector3d at(0.5, 1.6, 0.5);
  // The ball reaches the rim at y = 2, but not the floor at y = 0.5.
  const Vector3d mean = NormalAt(channel, at, {1, 0, 0}, 0.45);
  EXPECT_LT(mean.x(), -0.9);
  // Control: with a ball that also contains the floor, the normals of the legs nearly cancel.
  EXPECT_GT(NormalAt(channel, at, {1, 0, 0}, 1.3).x(), mean.x() + 0.1);
}

/// Make a sphere of radius 1 whose vertices are moved outward and inward alternately.
PolygonSoup RoughSphere() {
  PolygonSoup sphere = SphereSoup(30);
  for (std::size_t v = 0; v < sphere.vertices.size(); ++v) {
    sphere.vertices[v] *= 1 + 0.01 * std::sin(12.9898 * double(v) * double(v));
  }
  return sphere;
}

Polyhedron Felt(const PolygonSoup& soup, std::optional<double> radius, double degrees) {
  Reading reading;
  reading.patch = FeltPatch{radius, degrees * kPi / 180};
  return Polyhedron::FromSoup(soup, "soup", reading);
}

std::vector<bool> RoughCentroids(const Polyhedron& body) {
  std::vector<bool> rough;
  for (FaceIndex f{0}; f < body.face_count(); ++f) {
    rough.push_back(body.IsRough(f, body.CentroidOf(f)));
  }
  return rough;
}

auto CountRough(const Polyhedron& body) { return std::ranges::count(RoughCentroids(body), true); }

TEST(RoughPlaces, AreThoseBesideAnEdgeOfACube) {
  const Polyhedron cube = Felt(UnitCubeSoup(), 0.1, 5);
  FaceIndex top{0};
  while (cube.inward_normal(top).z() > -0.5) ++top;
  EXPECT_FALSE(cube.IsRough(top, {0, 0, 0.5}));
  EXPECT_FALSE(cube.IsRough(top, {0.405, 0, 0.5}));  // 2.8°
  EXPECT_TRUE(cube.IsRough(top, {0.45, 0, 0.5}));    // 25°
  const Polyhedron lenient = Felt(UnitCubeSoup(), 0.1, 44);
  EXPECT_FALSE(lenient.IsRough(top, {0.45, 0, 0.5}));
}

TEST(RoughPlaces, ASmoothSurfaceHasNoneAndANoisyOneHasSome) {
  EXPECT_EQ(CountRough(Felt(SphereSoup(30), 0.2, 5)), 0);
  const Polyhedron noisy = Felt(RoughSphere(), 0.2, 5);
  EXPECT_GT(CountRough(noisy), noisy.face_count() / 10);
  EXPECT_LT(CountRough(noisy), noisy.face_count());
  EXPECT_EQ(CountRough(Polyhedron::FromSoup(RoughSphere(), "soup")), 0);
}

TEST(RoughPlaces, AreFewerByALargerAngle) {
  const std::vector<bool> strict = RoughCentroids(Felt(RoughSphere(), 0.2, 4));
  const std::vector<bool> lenient = RoughCentroids(Felt(RoughSphere(), 0.2, 8));
  for (std::size_t f = 0; f < strict.size(); ++f) EXPECT_TRUE(strict[f] || !lenient[f]);
  EXPECT_LT(std::ranges::count(lenient, true), std::ranges::count(strict, true));
}

TEST(RoughPlaces, MoveAndScaleWithTheObject) {
  PolygonSoup moved = RoughSphere();
  Transform(moved, SomeMotion() * Eigen::Scaling(100.0));
  EXPECT_EQ(RoughCentroids(Felt(moved, 20, 5)), RoughCentroids(Felt(RoughSphere(), 0.2, 5)));
  EXPECT_EQ(RoughCentroids(Felt(moved, std::nullopt, 5)),
            RoughCentroids(Felt(RoughSphere(), std::nullopt, 5)));
}

TEST(FilledFaces, TakeFingersOnlyWhereThatIsAllowed) {
  PolygonSoup cube = UnitCubeSoup();
  cube.filled.assign(cube.facets.size(), false);
  cube.filled[2] = true;
  Reading allowing;
  allowing.allow_filled = true;
  const Polyhedron strict = Solid(cube);
  const Polyhedron lenient = Polyhedron::FromSoup(cube, "soup", allowing);
  int filled = 0;
  for (FaceIndex f{0}; f < strict.face_count(); ++f) {
    EXPECT_EQ(strict.TakesFingers(f), !strict.IsFilled(f));
    EXPECT_TRUE(lenient.TakesFingers(f));
    filled += lenient.IsFilled(f);
  }
  EXPECT_EQ(filled, 1);
}

}  // namespace patch_normal_test
}  // namespace regrasp::object
