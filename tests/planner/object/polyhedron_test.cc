#include "planner/object/polyhedron.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace polyhedron_test {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;
using namespace regrasp::soups;  // NOLINT: the meshes of this folder

constexpr double kTight = 1e-12;

/// Return the face whose outward normal is nearest to `outward`.
FaceIndex FaceTowards(const Polyhedron& body, const Vector3d& outward) {
  FaceIndex best{0};
  for (FaceIndex f{1}; f < body.face_count(); ++f) {
    if (body.inward_normal(f).dot(outward) < body.inward_normal(best).dot(outward)) best = f;
  }
  return best;
}

TEST(Polyhedron, ACubeHasSixFacesWithInwardNormals) {
  const Polyhedron cube = Polyhedron::FromSoup(UnitCubeSoup(), "cube");
  ASSERT_EQ(cube.face_count(), 6);
  EXPECT_EQ(cube.triangles().size(), 12u);
  EXPECT_EQ(cube.vertices().size(), 8u);
  EXPECT_NEAR(cube.diameter(), std::sqrt(3), kTight);
  for (FaceIndex f{0}; f < 6; ++f) {
    EXPECT_NEAR(cube.face_measure(f), 1, kTight);
    EXPECT_NEAR(cube.inward_normal(f).dot(cube.CentroidOf(f)), -0.5, kTight);
    EXPECT_EQ(cube.BordersOf(f).size(), 4u);
    EXPECT_EQ(cube.TrianglesOf(f).size(), 2u);
  }
}

/// Check that both faces of every border list it consistently. @returns number of concave ones.
int CheckBorders(const Polyhedron& body) {
  int concave = 0;
  for (FaceIndex face{0}; face < body.face_count(); ++face) {
    for (const FaceBorder& border : body.BordersOf(face)) {
      EXPECT_NE(border.beyond, face);
      EXPECT_TRUE(body.AreNeighbours(face, border.beyond));
      EXPECT_TRUE(body.AreNeighbours(border.beyond, face));
      const auto others = body.BordersOf(border.beyond);
      EXPECT_TRUE(std::ranges::any_of(others, [&](const FaceBorder& other) {
        return other.beyond == face && other.a == border.b && other.b == border.a &&
               other.convex == border.convex;
      }));
      concave += border.convex ? 0 : 1;
    }
  }
  return concave;
}

TEST(Polyhedron, FacesKnowTheirNeighboursAndWhichEdgesAreConcave) {
  const Polyhedron cube = Polyhedron::FromSoup(UnitCubeSoup(), "cube");
  EXPECT_EQ(CheckBorders(cube), 0);
  const FaceIndex top = FaceTowards(cube, Vector3d::UnitZ());
  EXPECT_EQ(cube.BordersOf(top).size(), 4u);
  EXPECT_FALSE(cube.AreNeighbours(top, FaceTowards(cube, -Vector3d::UnitZ())));
  EXPECT_FALSE(cube.AreNeighbours(top, top));
  // An L has one concave edge, a square hole four. Each is counted from both sides.
  EXPECT_EQ(CheckBorders(Polyhedron::FromSoup(LBlockSoup(), "ell")), 2);
  EXPECT_EQ(CheckBorders(Polyhedron::FromSoup(HoleBlockSoup(), "block")), 8);
  EXPECT_EQ(CheckBorders(Polyhedron::FromSoup(SphereSoup(8), "sphere")), 0);
}

TEST(Polyhedron, AMeshThatIsWhollyInwardIsTurned) {
  PolygonSoup soup = HoleBlockSoup();
  const Polyhedron outward = Polyhedron::FromSoup(soup, "block");
  Turn(soup);
  const Polyhedron turned = Polyhedron::FromSoup(soup, "block");
  ASSERT_EQ(turned.face_count(), outward.face_count());
  EXPECT_NEAR(turned.mass_properties().volume, 8, kTight);
  for (FaceIndex f{0}; f < turned.face_count(); ++f) {
    EXPECT_NEAR((turned.inward_normal(f) - outward.inward_normal(f)).norm(), 0, kTight);
    EXPECT_EQ(turned.BordersOf(f).size(), outward.BordersOf(f).size());
  }
}

TEST(Polyhedron, ACavityOrientedIntoTheMaterialIsPartOfTheSolid) {
  PolygonSoup cavity = BoxSoup(Vector3d::Constant(-0.1), Vector3d::Constant(0.2));
  Turn(cavity);
  const Polyhedron body = Polyhedron::FromSoup(Join(UnitCubeSoup(), cavity), "hollow");
  EXPECT_EQ(body.face_count(), 12);
  EXPECT_NEAR(body.mass_properties().volume, 1 - 0.027, kTight);
  EXPECT_THAT(body.FacesNear({0.2, 0, 0}, 1e-9), ElementsAre(9));
  EXPECT_NEAR(body.inward_normal(FaceIndex(9)).x(), 1, kTight);
}

TEST(Polyhedron, FacesBorderOnTheirOutlineAndHoles) {
  const Polyhedron block = Polyhedron::FromSoup(HoleBlockSoup(), "block");
  ASSERT_EQ(block.face_count(), 10);
  const FaceIndex top = FaceTowards(block, {0, 0, 1});
  EXPECT_NEAR(block.face_measure(top), 8, kTight);
  EXPECT_EQ(block.BordersOf(top).size(), 8u);
  // Seen from outside, the material is on the left.
  for (const FaceBorder& border : block.BordersOf(top)) {
    const Vector3d left = Vector3d::UnitZ().cross(border.b - border.a).normalized();
    const Vector3d inside = (border.a + border.b) / 2 + 0.1 * left;
    EXPECT_NEAR((block.ClosestPoint(top, inside) - inside).norm(), 0, kTight);
  }
}

TEST(Polyhedron, ClosestPointsRespectHolesAndNonConvexOutlines) {
  const Polyhedron block = Polyhedron::FromSoup(HoleBlockSoup(), "block");
  const FaceIndex top = FaceTowards(block, {0, 0, 1});
  EXPECT_NEAR((block.ClosestPoint(top, {1.2, 1.5, 3}) - Vector3d(1, 1.5, 1)).norm(), 0, kTight);
  EXPECT_NEAR((block.ClosestPoint(top, {0.5, 1.5, 3}) - Vector3d(0.5, 1.5, 1)).norm(), 0, kTight);
  const Polyhedron bent = Polyhedron::FromSoup(LBlockSoup(), "l");
  ASSERT_EQ(bent.face_count(), 8);
  const FaceIndex end = FaceTowards(bent, {0, 0, 1});
  EXPECT_NEAR((bent.ClosestPoint(end, {1.5, 1.2, 1}) - Vector3d(1.5, 1, 1)).norm(), 0, kTight);
}

/// Make a plate whose outline is an arc with `arc` corners, closed by a chord.
///
/// Its top is cut into triangles. At the origin the chord has a corner whose distance from it
/// underflows when squared.
PolygonSoup PlateWithASliver(int arc) {
  PolygonSoup soup;
  for (const double z : {0.0, -1.0}) {
    for (int i = 0; i < arc; ++i) {
      const double angle = M_PI * i / (arc - 1);
      soup.vertices.push_back({std::cos(angle), i == arc - 1 ? 0 : std::sin(angle), z});
    }
    soup.vertices.push_back({0, -1e-305, z});
  }
  const int corners = arc + 1;
  for (int i = 1; i < arc; ++i) soup.facets.push_back({0, i, i + 1});
  std::vector<int> bottom;
  for (int i = 0; i < corners; ++i) bottom.push_back(2 * corners - 1 - i);
  soup.facets.push_back(bottom);
  for (int i = 0; i < corners; ++i) {
    const int next = (i + 1) % corners;
    soup.facets.push_back({i, i + corners, next + corners, next});
  }
  return soup;
}

/// A point has no projection onto the plane of such a thin triangle.
TEST(Polyhedron, ClosestPointsOnFacesWithSliversAreFinite) {
  for (const int arc : {5, 40}) {  // without and with a tree
    const Polyhedron plate = Polyhedron::FromSoup(PlateWithASliver(arc), "plate");
    const FaceIndex top = FaceTowards(plate, {0, 0, 1});
    ASSERT_EQ(plate.TrianglesOf(top).size(), static_cast<std::size_t>(arc - 1));
    for (const Vector3d& over : {Vector3d(0, 0.3, 0), Vector3d(0, 0, 0), Vector3d(-0.5, 0, 0)}) {
      EXPECT_NEAR((plate.ClosestPoint(top, over + Vector3d(0, 0, 1)) - over).norm(), 0, kTight);
      EXPECT_NEAR(
          (plate.ClosestPoint(top, over - Vector3d(0, over.y() + 2, 0)) - Vector3d(over.x(), 0, 0))
              .norm(),
          0, kTight);
    }
  }
}

TEST(Polyhedron, FacesNearAreSortedByDistance) {
  const Polyhedron cube = Polyhedron::FromSoup(UnitCubeSoup(), "cube");
  const FaceIndex right = FaceTowards(cube, {1, 0, 0}), top = FaceTowards(cube, {0, 0, 1});
  EXPECT_THAT(cube.FacesNear({0.45, 0, 0.48}, 0.1), ElementsAre(top, right));
  EXPECT_THAT(cube.FacesNear({0.48, 0, 0.45}, 0.1), ElementsAre(right, top));
  EXPECT_THAT(cube.FacesNear({0.48, 0, 0.45}, 0.03), ElementsAre(right));
  EXPECT_THAT(cube.FacesNear({0.5, 0, 0.5}, 0), UnorderedElementsAre(right, top));
  EXPECT_THAT(cube.FacesNear({0, 0, 0}, 0.4), ElementsAre());
  EXPECT_EQ(cube.FacesNear({0, 0, 0}, 10).size(), 6u);
}

TEST(Polyhedron, SegmentsMustStayOnTheFaceAllTheWay) {
  const Polyhedron block = Polyhedron::FromSoup(HoleBlockSoup(), "block");
  const FaceIndex top = FaceTowards(block, {0, 0, 1});
  const double within = 1e-6;
  EXPECT_TRUE(block.ContainsSegment(top, {0.1, 0.5, 1}, {2.9, 0.5, 1}, within));
  EXPECT_FALSE(block.ContainsSegment(top, {0.5, 1.5, 1}, {2.5, 1.5, 1}, within)) << "over the hole";
  EXPECT_TRUE(block.ContainsSegment(top, {0.5, 1, 1}, {2.5, 1, 1}, within)) << "along its border";
  EXPECT_TRUE(block.ContainsSegment(top, {0, 0, 1}, {3, 0, 1}, within)) << "along the outline";
  EXPECT_FALSE(block.ContainsSegment(top, {0, 0, 1}, {3.1, 0, 1}, within));
  EXPECT_FALSE(block.ContainsSegment(top, {0.5, 0.5, 1}, {0.5, 0.6, 1.1}, within)) << "off it";
  EXPECT_TRUE(block.ContainsSegment(top, {0.5, 0.5, 1}, {0.5, 0.5, 1}, within)) << "a point";
  const Polyhedron bent = Polyhedron::FromSoup(LBlockSoup(), "l");
  const FaceIndex end = FaceTowards(bent, {0, 0, 1});
  EXPECT_FALSE(bent.ContainsSegment(end, {1.8, 0.5, 1}, {0.5, 1.8, 1}, within)) << "over the notch";
  EXPECT_TRUE(bent.ContainsSegment(end, {1.5, 0.5, 1}, {0.5, 1.5, 1}, within)) << "by the corner";
}

/// Compares queries at many points of a face with many triangles with closed forms of the rectangle
/// and its hole.
TEST(Polyhedron, QueriesOnAFineFaceAgreeWithClosedForms) {
  // The top of the block has 4 · 32 · 2 triangles, so that trees of boxes are used.
  constexpr int kCuts = 12;
  PolygonSoup soup;
  const auto grid = [&](int i, int j, int k) { return (k * (kCuts + 1) + j) * (kCuts + 1) + i; };
  const auto solid = [&](int i, int j) {
    const auto middle = [](int c) { return c >= kCuts / 3 && c < 2 * kCuts / 3; };
    return i >= 0 && j >= 0 && i < kCuts && j < kCuts && !(middle(i) && middle(j));
  };
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= kCuts; ++j) {
      for (int i = 0; i <= kCuts; ++i) {
        soup.vertices.push_back({3.0 * i / kCuts, 3.0 * j / kCuts, double(k)});
      }
    }
  }
  for (int i = 0; i < kCuts; ++i) {
    for (int j = 0; j < kCuts; ++j) {
      if (!solid(i, j)) continue;
      const auto wall = [&](int a, int b, int c, int d) {
        soup.facets.push_back({grid(a, b, 0), grid(c, d, 0), grid(c, d, 1), grid(a, b, 1)});
      };
      soup.facets.push_back(
          {grid(i, j, 1), grid(i + 1, j, 1), grid(i + 1, j + 1, 1), grid(i, j + 1, 1)});
      soup.facets.push_back(
          {grid(i, j, 0), grid(i, j + 1, 0), grid(i + 1, j + 1, 0), grid(i + 1, j, 0)});
      if (!solid(i, j - 1)) wall(i, j, i + 1, j);
      if (!solid(i + 1, j)) wall(i + 1, j, i + 1, j + 1);
      if (!solid(i, j + 1)) wall(i + 1, j + 1, i, j + 1);
      if (!solid(i - 1, j)) wall(i, j + 1, i, j);
    }
  }
  const Polyhedron block = Polyhedron::FromSoup(soup, "fine block");
  ASSERT_EQ(block.face_count(), 10);
  EXPECT_NEAR(block.mass_properties().volume, 8, 1e-9);
  const FaceIndex top = FaceTowards(block, {0, 0, 1});
  ASSERT_EQ(block.TrianglesOf(top).size(), 256u);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.5, 3.5);
  const auto outside_rectangle = [](const Vector3d& p, double low, double high) {
    const Vector3d nearest(std::clamp(p.x(), low, high), std::clamp(p.y(), low, high), p.z());
    return (p - nearest).norm();
  };
  const auto inside_rectangle = [](const Vector3d& p, double low, double high) {
    return std::min({p.x() - low, high - p.x(), p.y() - low, high - p.y()});
  };
  int on_face = 0, off_face = 0, covered = 0, uncovered = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p(within(random), within(random), 1);
    const double outside = outside_rectangle(p, 0, 3);
    const double in_hole = inside_rectangle(p, 1, 2);
    const double expected = std::max({outside, in_hole, 0.0});
    EXPECT_NEAR((block.ClosestPoint(top, p) - p).norm(), expected, 1e-9);
    (expected == 0 ? on_face : off_face)++;
    const double to_outline = outside > 0 ? outside : inside_rectangle(p, 0, 3);
    const double to_hole = in_hole > 0 ? in_hole : outside_rectangle(p, 1, 2);
    EXPECT_NEAR(block.DistanceToBorder(top, p), std::min(to_outline, to_hole), 1e-9);
    const auto near = block.FacesNear(p, 1e-9);
    EXPECT_EQ(std::ranges::count(near, top), expected == 0 ? 1 : 0);

    // A segment is on the face iff each of many points on it is.
    const Vector3d q = p + Vector3d(within(random) - 1.5, within(random) - 1.5, 0);
    double worst = 0;
    for (int s = 0; s <= 1000; ++s) {
      const Vector3d r = p + s / 1000.0 * (q - p);
      worst = std::max({worst, outside_rectangle(r, 0, 3), inside_rectangle(r, 1, 2)});
    }
    const bool contained = block.ContainsSegment(top, p, q, 1e-6);
    EXPECT_EQ(contained, worst <= 1e-6) << p.transpose() << " to " << q.transpose();
    (contained ? covered : uncovered)++;
  }
  EXPECT_GT(on_face, 100);
  EXPECT_GT(off_face, 100);
  EXPECT_GT(covered, 100);
  EXPECT_GT(uncovered, 100);
}

}  // namespace polyhedron_test

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
