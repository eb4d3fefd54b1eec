#include "planner/sampling/contact_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/read_object.h"
#include "planner/sampling/surface_sampler.h"
#include "tests/fixtures/solids.h"
#include "tests/fixtures/soups.h"

namespace regrasp::sampling {
namespace contact_points_test {

/// Rounding error of a projection onto a face, relative to the diameter.
constexpr double kOnFace = 1e-12;

TEST(SpreadContactPoints, LieOnTheirFacesWithRoomToTheBorder) {
  const object::Polyhedron box = MakeBox({0.1, 0.06, 0.03});
  const std::vector<grasp::Contact> points = SpreadContactPoints(box, 60, 1);
  ASSERT_EQ(points.size(), 60u);
  for (const grasp::Contact& c : points) {
    EXPECT_LE((box.ClosestPoint(c.face, c.p) - c.p).norm(), kOnFace * box.diameter());
    EXPECT_EQ(c.n, box.inward_normal(c.face));
    EXPECT_GE(box.DistanceToBorder(c.face, c.p), kBorderMargin * box.diameter());
  }
}

TEST(SpreadContactPoints, GiveEachFaceItsShareOfTheArea) {
  const object::Polyhedron box = MakeBox({0.1, 0.06, 0.03});
  const std::vector<grasp::Contact> points = SpreadContactPoints(box, 100, 2);
  double area = 0;
  for (FaceIndex face{0}; face < box.face_count(); ++face) area += box.face_measure(face);
  for (FaceIndex face{0}; face < box.face_count(); ++face) {
    const auto count = std::count_if(points.begin(), points.end(),
                                     [&](const grasp::Contact& c) { return c.face == face; });
    // Random points would deviate by more than four on one face out of three.
    EXPECT_NEAR(count, 100 * box.face_measure(face) / area, 4) << "face " << face;
  }
}

TEST(SpreadContactPoints, AreTheSameForTheSameSeedOnly) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  const std::vector<grasp::Contact> a = SpreadContactPoints(cube, 30, 5);
  const std::vector<grasp::Contact> b = SpreadContactPoints(cube, 30, 5);
  const std::vector<grasp::Contact> c = SpreadContactPoints(cube, 30, 6);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].p, b[i].p);
  EXPECT_NE(a[0].p, c[0].p);
}

TEST(SpreadContactPoints, AreCentroidsOfTheTrianglesWhereTheMeshIsFine) {
  const auto off_centroids = [](const object::Polyhedron& solid, int count) {
    const std::vector<grasp::Contact> points = SpreadContactPoints(solid, count, 1);
    EXPECT_EQ(static_cast<int>(points.size()), count);
    return std::count_if(points.begin(), points.end(), [&](const grasp::Contact& c) {
      return std::none_of(solid.triangles().begin(), solid.triangles().end(),
                          [&](const auto& triangle) {
                            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
                            for (const int v : triangle) sum += solid.vertices()[v];
                            return (sum / 3 - c.p).norm() <= kOnFace * solid.diameter();
                          });
    });
  };
  EXPECT_EQ(off_centroids(MakeBox({0.06, 0.06, 0.06}, 10), 60), 0);
  EXPECT_GT(off_centroids(MakeBox({0.06, 0.06, 0.06}), 60), 50);
}

TEST(SpreadContactPoints, DoNotDependOnTheUnitOfLength) {
  const std::vector<grasp::Contact> metres = SpreadContactPoints(MakeBox({1, 2, 4}), 20, 3);
  const std::vector<grasp::Contact> halves = SpreadContactPoints(MakeBox({2, 4, 8}), 20, 3);
  ASSERT_EQ(metres.size(), halves.size());
  for (std::size_t i = 0; i < metres.size(); ++i) EXPECT_EQ(2 * metres[i].p, halves[i].p);
}

TEST(SpreadContactPoints, RefusesNone) {
  EXPECT_THROW((void)SpreadContactPoints(MakeBox({0.06, 0.06, 0.06}), 0, 1), std::invalid_argument);
}

/// Return the same solid with mapped vertices.
template <typename Map>
object::Polyhedron Moved(const object::Polyhedron& solid, const Map& map) {
  object::PolygonSoup soup;
  for (const Eigen::Vector3d& v : solid.vertices()) soup.vertices.push_back(map(v));
  for (const auto& [a, b, c] : solid.triangles()) soup.facets.push_back({a, b, c});
  return object::Polyhedron::FromSoup(soup, "moved");
}

constexpr int kPotatoTriangles = 6 * 4 * 4 * 2;

/// Return a box of four cells per edge, deformed so that no two triangles are coplanar.
object::Polyhedron MakePotato() {
  return Moved(MakeBox({2, 3, 4}, 4), [](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    const Eigen::Vector3d n = v.normalized();
    return (1 + 0.1 * std::sin(2 * n.x() + 3 * n.y() + n.z())) * n;
  });
}

TEST(MeshContacts, AreTheCentroidsOfAllTrianglesInTheirOrder) {
  const object::Polyhedron potato = MakePotato();
  ASSERT_EQ(potato.face_count(), kPotatoTriangles);
  const std::vector<grasp::Contact> points = MeshContacts(potato, kPotatoTriangles, 1);
  ASSERT_EQ(points.size(), std::size_t{kPotatoTriangles});
  for (int i = 0; i < kPotatoTriangles; ++i) {
    const auto& [a, b, c] = potato.triangles()[i];
    const auto& v = potato.vertices();
    EXPECT_LE((points[i].p - (v[a] + v[b] + v[c]) / 3).norm(), kOnFace * potato.diameter());
    EXPECT_EQ(points[i].face, potato.face_of_triangle(object::TriangleIndex(i)));
    EXPECT_EQ(points[i].n, potato.inward_normal(points[i].face));
  }
}

TEST(MeshContacts, MoveAndGrowWithTheSolidWhateverTheSeed) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto map = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return 37.5 * (turn * v) + Eigen::Vector3d(3, -8, 21);
  };
  const object::Polyhedron potato = MakePotato();
  const object::Polyhedron moved = Moved(potato, map);
  const std::vector<grasp::Contact> before = MeshContacts(potato, 300, 1);
  const std::vector<grasp::Contact> after = MeshContacts(moved, 300, 2);
  ASSERT_EQ(before.size(), std::size_t{kPotatoTriangles});
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LE((after[i].p - map(before[i].p)).norm(), kOnFace * moved.diameter());
    EXPECT_LE((after[i].n - turn * before[i].n).norm(), kOnFace);
  }
}

TEST(MeshContacts, AreSpreadWhereTrianglesAreTooManyOrFacesTooFew) {
  const object::Polyhedron potato = MakePotato();
  struct Case {
    int most;
    bool centroids;
  };
  int spread = 0;
  for (const auto& [most, centroids] :
       {Case{kPotatoTriangles - 1, false}, Case{kPotatoTriangles, true},
        Case{kFewFaces * kPotatoTriangles, true}, Case{kFewFaces * kPotatoTriangles + 1, false}}) {
    const std::vector<grasp::Contact> points = MeshContacts(potato, most, 1);
    if (centroids) {
      EXPECT_EQ(points.size(), std::size_t{kPotatoTriangles}) << most;
      continue;
    }
    const std::vector<grasp::Contact> expected = SpreadContactPoints(potato, most, 1);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(most));
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].p, expected[i].p);
    ++spread;
  }
  EXPECT_EQ(spread, 2);
}

TEST(MeshContacts, AreSpreadOnFlatFacesHoweverTheseAreCut) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06}, 4);
  ASSERT_EQ(cube.triangles().size(), std::size_t{kPotatoTriangles});
  EXPECT_EQ(MeshContacts(cube, 300, 1).size(), 300u);
  EXPECT_EQ(MeshContacts(MakeBox({0.06, 0.06, 0.06}), 300, 1).size(), 300u);
}

TEST(MeshContacts, RefusesNone) {
  EXPECT_THROW((void)MeshContacts(MakeBox({0.06, 0.06, 0.06}), 0, 1), std::invalid_argument);
}

}  // namespace contact_points_test

namespace given_contacts_test {

using Eigen::Vector3d;

object::Polyhedron SphereOf(int rows) {
  return object::Polyhedron::FromSoup(soups::SphereSoup(rows), "sphere");
}

TEST(GivenContacts, AreAtTheirPointsInsideAFaceWithItsNormal) {
  const object::Polyhedron sphere = SphereOf(30);
  const std::vector<grasp::Contact> contacts = GivenContacts(sphere, sphere.vertices(), 4, 100, 1);
  ASSERT_EQ(contacts.size(), 100u);
  for (const grasp::Contact& c : contacts) {
    const double off = (object::NearestPoint(sphere.vertices(), c.p) - c.p).norm();
    EXPECT_LE(off, object::kAtGivenPoint * sphere.diameter());
    EXPECT_GE(sphere.DistanceToBorder(c.face, c.p),
              0.999 * SurfaceSampler::kFromBorder * sphere.diameter());
    EXPECT_EQ(c.n, sphere.inward_normal(c.face));
    // The normal is radial up to the angle between triangles of this size.
    EXPECT_LT(c.n.dot(c.p.normalized()), -std::cos(Radians(12)));
  }
}

TEST(GivenContacts, AreAllThereWhereThereAreFewAndTheSameForTheSameSeed) {
  const object::Polyhedron sphere = SphereOf(8);
  const auto all = GivenContacts(sphere, sphere.vertices(), 4, 1000, 1);
  // The two poles are excluded: their corners are so sharp that a contact inside a triangle would
  // be too far away.
  EXPECT_EQ(all.size(), sphere.vertices().size() - 2);
  const auto some = GivenContacts(sphere, sphere.vertices(), 4, 10, 1);
  const auto again = GivenContacts(sphere, sphere.vertices(), 4, 10, 1);
  ASSERT_EQ(some.size(), 10u);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i].p, again[i].p);
}

TEST(ContactAt, APointInsideAFaceIsTheContact) {
  const object::Polyhedron cube = MakeBox({1, 1, 1});
  const Vector3d point = cube.CentroidOf(FaceIndex(0)) + Vector3d(0, 0, 0);
  const auto contact = ContactAt(cube, point);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->p, cube.ClosestPoint(FaceIndex(0), point));
}

TEST(ContactAt, NoContactIsAtAPointOffTheSurfaceOrWhereItIsRough) {
  const object::Polyhedron cube = MakeBox({1, 1, 1});
  EXPECT_FALSE(ContactAt(cube, 1.01 * cube.vertices()[0]));
  EXPECT_TRUE(ContactAt(cube, cube.vertices()[0]));
  object::Reading reading;
  reading.patch = object::FeltPatch{0.05, Radians(5)};
  const object::Polyhedron felt =
      object::Polyhedron::FromSoup(soups::UnitCubeSoup(), "cube", reading);
  EXPECT_FALSE(ContactAt(felt, felt.vertices()[0]));
}

TEST(GivenContacts, TooFewOfThemAreNoPlaceForAGrasp) {
  const object::Polyhedron sphere = SphereOf(8);
  std::vector<Vector3d> outside = sphere.vertices();
  for (Vector3d& p : outside) p *= 1.1;
  EXPECT_THROW((void)GivenContacts(sphere, outside, 4, 100, 1), NoGrasp);
}

}  // namespace given_contacts_test
}  // namespace regrasp::sampling
