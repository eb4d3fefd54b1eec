#include "planner/sampling/given_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/read_object.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/sampling/surface_sampler.h"
#include "tests/fixtures/solids.h"
#include "tests/fixtures/soups.h"

namespace regrasp::sampling {
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
