#include "planner/roadmap/contact_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "tests/planner/roadmap/solids.h"

namespace regrasp {
namespace {

/// Rounding of a projection onto a face, relative to the diameter.
constexpr double kOnFace = 1e-12;

TEST(SpreadContactPoints, LieOnTheirFacesWithRoomToTheBorder) {
  const Polyhedron box = MakeBox({0.1, 0.06, 0.03});
  const std::vector<Contact> points = SpreadContactPoints(box, 60, 1);
  ASSERT_EQ(points.size(), 60u);
  for (const Contact& c : points) {
    EXPECT_LE((box.ClosestPoint(c.face, c.p) - c.p).norm(), kOnFace * box.diameter());
    EXPECT_EQ(c.n, box.inward_normal(c.face));
    EXPECT_GE(box.DistanceToBorder(c.face, c.p), kBorderMargin * box.diameter());
  }
}

TEST(SpreadContactPoints, GiveEachFaceItsShareOfTheArea) {
  const Polyhedron box = MakeBox({0.1, 0.06, 0.03});
  const std::vector<Contact> points = SpreadContactPoints(box, 100, 2);
  double area = 0;
  for (int face = 0; face < box.face_count(); ++face) area += box.face_measure(face);
  for (int face = 0; face < box.face_count(); ++face) {
    const auto count = std::count_if(points.begin(), points.end(),
                                     [&](const Contact& c) { return c.face == face; });
    // Purely random points would be off by more than four in one face out of three.
    EXPECT_NEAR(count, 100 * box.face_measure(face) / area, 4) << "face " << face;
  }
}

TEST(SpreadContactPoints, AreTheSameForTheSameSeedOnly) {
  const Polyhedron cube = MakeCube();
  const std::vector<Contact> a = SpreadContactPoints(cube, 30, 5);
  const std::vector<Contact> b = SpreadContactPoints(cube, 30, 5);
  const std::vector<Contact> c = SpreadContactPoints(cube, 30, 6);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].p, b[i].p);
  EXPECT_NE(a[0].p, c[0].p);
}

TEST(SpreadContactPoints, AreCentroidsOfTheTrianglesWhereTheMeshIsFine) {
  const auto off_centroids = [](const Polyhedron& solid, int count) {
    const std::vector<Contact> points = SpreadContactPoints(solid, count, 1);
    EXPECT_EQ(static_cast<int>(points.size()), count);
    return std::count_if(points.begin(), points.end(), [&](const Contact& c) {
      return std::none_of(solid.triangles().begin(), solid.triangles().end(),
                          [&](const auto& triangle) {
                            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                            for (const int v : triangle) sum += solid.vertices()[v];
                            return (sum / 3 - c.p).norm() <= kOnFace * solid.diameter();
                          });
    });
  };
  EXPECT_EQ(off_centroids(MakeBox({0.06, 0.06, 0.06}, 10), 60), 0);
  EXPECT_GT(off_centroids(MakeCube(), 60), 50);
}

TEST(SpreadContactPoints, DoNotDependOnTheUnitOfLength) {
  const std::vector<Contact> metres = SpreadContactPoints(MakeBox({1, 2, 4}), 20, 3);
  const std::vector<Contact> halves = SpreadContactPoints(MakeBox({2, 4, 8}), 20, 3);
  ASSERT_EQ(metres.size(), halves.size());
  for (std::size_t i = 0; i < metres.size(); ++i) EXPECT_EQ(2 * metres[i].p, halves[i].p);
}

TEST(SpreadContactPoints, RefusesNone) {
  EXPECT_THROW((void)SpreadContactPoints(MakeCube(), 0, 1), std::invalid_argument);
}

/// The triangles of a box of 2 × 3 × 4, four cells along each of its edges.
constexpr int kBoxTriangles = 6 * 4 * 4 * 2;

Polyhedron MakeFineBox() { return MakeBox({2, 3, 4}, 4); }

/// The same solid, every vertex mapped.
template <typename Map>
Polyhedron Moved(const Polyhedron& solid, const Map& map) {
  PolygonSoup soup;
  for (const Eigen::Vector3d& v : solid.vertices()) soup.vertices.push_back(map(v));
  for (const auto& [a, b, c] : solid.triangles()) soup.facets.push_back({a, b, c});
  return Polyhedron::FromSoup(soup, "moved");
}

TEST(MeshContacts, AreTheCentroidsOfAllTrianglesInTheirOrder) {
  const Polyhedron box = MakeFineBox();
  const std::vector<Contact> points = MeshContacts(box, kBoxTriangles, 1);
  ASSERT_EQ(points.size(), std::size_t{kBoxTriangles});
  for (int i = 0; i < kBoxTriangles; ++i) {
    const auto& [a, b, c] = box.triangles()[i];
    const auto& v = box.vertices();
    EXPECT_LE((points[i].p - (v[a] + v[b] + v[c]) / 3).norm(), kOnFace * box.diameter());
    EXPECT_EQ(points[i].face, box.face_of_triangle(i));
    EXPECT_EQ(points[i].n, box.inward_normal(points[i].face));
  }
}

TEST(MeshContacts, MoveAndGrowWithTheSolidWhateverTheSeed) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto map = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return 37.5 * (turn * v) + Eigen::Vector3d(3, -8, 21);
  };
  const Polyhedron box = MakeFineBox();
  const Polyhedron moved = Moved(box, map);
  const std::vector<Contact> before = MeshContacts(box, 300, 1);
  const std::vector<Contact> after = MeshContacts(moved, 300, 2);
  ASSERT_EQ(before.size(), std::size_t{kBoxTriangles});
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LE((after[i].p - map(before[i].p)).norm(), kOnFace * moved.diameter());
    EXPECT_LE((after[i].n - turn * before[i].n).norm(), kOnFace);
  }
}

TEST(MeshContacts, AreSpreadWhereTrianglesAreTooManyOrTooFew) {
  const Polyhedron box = MakeFineBox();
  struct Case {
    int most;
    bool centroids;
  };
  int spread = 0;
  for (const auto& [most, centroids] : {Case{kBoxTriangles - 1, false}, Case{kBoxTriangles, true},
                                        Case{kFewTriangles * kBoxTriangles, true},
                                        Case{kFewTriangles * kBoxTriangles + 1, false}}) {
    const std::vector<Contact> points = MeshContacts(box, most, 1);
    if (centroids) {
      EXPECT_EQ(points.size(), std::size_t{kBoxTriangles}) << most;
      continue;
    }
    const std::vector<Contact> expected = SpreadContactPoints(box, most, 1);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(most));
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].p, expected[i].p);
    ++spread;
  }
  EXPECT_EQ(spread, 2);
}

TEST(MeshContacts, RefusesNone) {
  EXPECT_THROW((void)MeshContacts(MakeCube(), 0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace regrasp
