#include "planner/roadmap/contact_points.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace regrasp
