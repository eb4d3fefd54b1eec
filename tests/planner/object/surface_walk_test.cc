#include "planner/object/surface_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace surface_walk_test {

using Eigen::Vector3d;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

Polyhedron Solid(const PolygonSoup& soup) { return Polyhedron::FromSoup(soup, "soup"); }

/// Return the face of a cube or square whose outward normal is nearest to `outward`.
FaceIndex FaceTowards(const Object& object, const Vector3d& outward) {
  FaceIndex best{0};
  for (FaceIndex f{0}; f < object.face_count(); ++f) {
    if (object.inward_normal(f).dot(outward) < object.inward_normal(best).dot(outward)) best = f;
  }
  return best;
}

double LengthOf(const std::vector<SurfaceLeg>& legs) {
  double length = 0;
  for (const SurfaceLeg& leg : legs) length += (leg.to - leg.from).norm();
  return length;
}

void ExpectConnected(const Object& object, const std::vector<SurfaceLeg>& legs) {
  for (std::size_t k = 1; k < legs.size(); ++k) EXPECT_EQ(legs[k].from, legs[k - 1].to);
  for (std::size_t k = 0; k < legs.size(); ++k) {
    for (const Vector3d& p : {legs[k].from, legs[k].to}) {
      EXPECT_LE((object.ClosestPoint(legs[k].face, p) - p).norm(),
                kPointTolerance * object.diameter());
    }
  }
}

TEST(WalkStraight, InsideAFaceIsTheDisplacement) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  const FaceIndex top = FaceTowards(cube, {0, 0, 1});
  const Vector3d from(0.1, 0.2, 0.5), way(0.3, -0.4, 0);
  const auto legs = WalkStraight(cube, top, from, way);
  ASSERT_TRUE(legs);
  ASSERT_EQ(legs->size(), 1U);
  EXPECT_EQ(legs->front().to, Vector3d(from + way));
}

TEST(WalkStraight, UnfoldsACubeAcrossItsEdges) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  // Across the edge at x = 0.5 and then downward, with the same direction along the edge.
  const auto legs = WalkStraight(cube, FaceTowards(cube, {0, 0, 1}), {0.4, 0, 0.5}, {0.3, 0.3, 0});
  ASSERT_TRUE(legs);
  ASSERT_EQ(legs->size(), 2U);
  EXPECT_EQ(legs->back().face, FaceTowards(cube, {1, 0, 0}));
  EXPECT_LT((legs->front().to - Vector3d(0.5, 0.1, 0.5)).norm(), 1e-12);
  EXPECT_LT((legs->back().to - Vector3d(0.5, 0.3, 0.3)).norm(), 1e-12);
  // Once around, across four edges.
  const auto round = WalkStraight(cube, FaceTowards(cube, {0, 0, 1}), {0.4, 0.1, 0.5}, {4, 0, 0});
  ASSERT_TRUE(round);
  EXPECT_EQ(round->size(), 5U);
  EXPECT_LT((round->back().to - Vector3d(0.4, 0.1, 0.5)).norm(), 1e-12);
}

TEST(WalkStraight, OnAFlatFaceThatIsCutFinelyEndsWhereItDoesOnTheOneFace) {
  const Polyhedron whole = Solid(BoxSoup({0, 0, -1}, {1, 1, 0}));
  const Polyhedron flat = Solid(GriddedBoxSoup(40, 0));
  ASSERT_EQ(flat.face_count(), whole.face_count());
  // Bent by a few hundredths of a degree: each triangle is a face, and they are nearly coplanar.
  const Polyhedron cut = Solid(GriddedBoxSoup(40, 1e-5));
  ASSERT_GT(cut.face_count(), 1000);
  RandomStream random(2, RandomUse::kTrialContacts);
  int crossings = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d from(0.4 + 0.2 * random.Uniform(), 0.4 + 0.2 * random.Uniform(), 0);
    const Vector3d way(0.1 * random.Normal(), 0.1 * random.Normal(), 0);
    const auto expected = WalkStraight(whole, FaceTowards(whole, {0, 0, 1}), from, way);
    const auto same = WalkStraight(flat, FaceTowards(flat, {0, 0, 1}), from, way);
    ASSERT_TRUE(expected && same);
    EXPECT_EQ(same->back().to, expected->back().to);
    const FaceIndex face = cut.FacesNear(from, 1e-4).front();
    const Vector3d on_face = cut.ClosestPoint(face, from);
    const Vector3d& n = cut.inward_normal(face);
    const auto legs = WalkStraight(cut, face, on_face, way - n * n.dot(way));
    ASSERT_TRUE(legs);
    EXPECT_LT((legs->back().to - expected->back().to).norm(), 1e-4);
    ExpectConnected(cut, *legs);
    crossings += static_cast<int>(legs->size()) - 1;
  }
  EXPECT_GT(crossings, 1000);
}

TEST(WalkStraight, OnASphereIsAGreatCircleAllBut) {
  const Polyhedron sphere = Solid(SphereSoup(60));
  int checked = 0;
  for (FaceIndex f{0}; f < sphere.face_count(); f = FaceIndex(f + 101)) {
    const Vector3d from = sphere.CentroidOf(f);
    const Vector3d way = 1.0 * sphere.inward_normal(f).unitOrthogonal();
    const auto legs = WalkStraight(sphere, f, from, way);
    if (!legs) continue;
    const Vector3d expected = std::cos(1.0) * from.normalized() + std::sin(1.0) * way.normalized();
    EXPECT_LT((legs->back().to - expected).norm(), 0.05) << f;
    EXPECT_NEAR(LengthOf(*legs), 1, 1e-9);
    ExpectConnected(sphere, *legs);
    ++checked;
  }
  EXPECT_GT(checked, 50);
}

TEST(WalkStraight, MovesAndScalesWithTheObject) {
  const Eigen::Affine3d motion = SomeMotion() * Eigen::Scaling(100.0);
  PolygonSoup moved = SphereSoup(20);
  Transform(moved, motion);
  const Polyhedron sphere = Solid(SphereSoup(20)), far = Solid(moved);
  const FaceIndex f{7};
  const Vector3d way = 0.3 * sphere.inward_normal(f).unitOrthogonal();
  const auto legs = WalkStraight(sphere, f, sphere.CentroidOf(f), way);
  const auto there = WalkStraight(far, f, motion * sphere.CentroidOf(f), motion.linear() * way);
  ASSERT_TRUE(legs && there);
  EXPECT_GT(legs->size(), 2U);
  EXPECT_LT((there->back().to - motion * legs->back().to).norm(), 1e-9);
}

TEST(WalkStraight, GoesAlongTheBoundaryOfAPolygon) {
  const Polygon square = Polygon::FromRings({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, "square");
  const FaceIndex below = FaceTowards(square, {0, -1, 0});
  const auto legs = WalkStraight(square, below, {0.5, -1, 0}, {1, 0, 0});
  ASSERT_TRUE(legs);
  ASSERT_EQ(legs->size(), 2U);
  EXPECT_EQ(legs->back().face, FaceTowards(square, {1, 0, 0}));
  EXPECT_LT((legs->back().to - Vector3d(1, -0.5, 0)).norm(), 1e-12);
  const auto back = WalkStraight(square, legs->back().face, legs->back().to, {0, -1, 0});
  ASSERT_TRUE(back);
  EXPECT_LT((back->back().to - Vector3d(0.5, -1, 0)).norm(), 1e-12);
  const auto round = WalkStraight(square, below, {0.5, -1, 0}, {-8, 0, 0});
  ASSERT_TRUE(round);
  EXPECT_EQ(round->size(), 5U);
  EXPECT_LT((round->back().to - Vector3d(0.5, -1, 0)).norm(), 1e-12);
}

TEST(HeadFor, FindsAWayAlongASphereAndAcrossACubesEdge) {
  const Polyhedron sphere = Solid(SphereSoup(40));
  int found = 0;
  for (FaceIndex f{0}; f < sphere.face_count(); f = FaceIndex(f + 61)) {
    const Vector3d way = 0.2 * sphere.inward_normal(f).unitOrthogonal();
    const auto straight = WalkStraight(sphere, f, sphere.CentroidOf(f), way);
    if (!straight) continue;
    const SurfaceLeg& end = straight->back();
    const auto legs = HeadFor(sphere, f, sphere.CentroidOf(f), end.face, end.to);
    ASSERT_TRUE(legs) << f;
    EXPECT_EQ(legs->back().face, end.face);
    EXPECT_EQ(legs->back().to, end.to);
    EXPECT_LT(LengthOf(*legs), 0.21);
    ExpectConnected(sphere, *legs);
    ++found;
  }
  EXPECT_GT(found, 20);
  const Polyhedron cube = Solid(UnitCubeSoup());
  const auto legs = HeadFor(cube, FaceTowards(cube, {0, 0, 1}), {0.4, 0, 0.5},
                            FaceTowards(cube, {1, 0, 0}), {0.5, 0.1, 0.4});
  ASSERT_TRUE(legs);
  EXPECT_EQ(legs->size(), 2U);
}

TEST(HeadFor, TakesTheShortWayAroundSharpCorners) {
  // An angle of 27° at (2, 0).
  const Polygon wedge = Polygon::FromRings({{{0, 0}, {2, 0}, {0, 1}}}, "wedge");
  const FaceIndex below = FaceTowards(wedge, {0, -1, 0}), above = FaceTowards(wedge, {1, 2, 0});
  const auto legs = HeadFor(wedge, below, {1.8, 0, 0}, above, {1.8, 0.1, 0});
  ASSERT_TRUE(legs);
  ASSERT_EQ(legs->size(), 2U);
  EXPECT_EQ(legs->front().to, Vector3d(2, 0, 0));
  // The same as a prism.
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}}) {
      soup.vertices.push_back({x, y, z});
    }
  }
  soup.facets = {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  const Polyhedron prism = Solid(soup);
  const auto over = HeadFor(prism, FaceTowards(prism, {0, -1, 0}), {1.8, 0, 0.5},
                            FaceTowards(prism, {1, 2, 0}), {1.8, 0.1, 0.5});
  ASSERT_TRUE(over);
  ASSERT_EQ(over->size(), 2U);
  EXPECT_LT((over->front().to - Vector3d(2, 0, 0.5)).norm(), 1e-12);
  ExpectConnected(prism, *over);
}

TEST(HeadFor, SaysWhereItFindsNone) {
  const Polyhedron cube = Solid(UnitCubeSoup());
  // The goal is on the opposite face of the cube, straight through the material.
  EXPECT_FALSE(HeadFor(cube, FaceTowards(cube, {0, 0, 1}), {0, 0, 0.5},
                       FaceTowards(cube, {0, 0, -1}), {0, 0, -0.5}));
}

}  // namespace surface_walk_test
}  // namespace regrasp::object
