#include "planner/sampling/surface_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "planner/criteria/reach.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/solids.h"

namespace regrasp::sampling {
namespace surface_sampler_test {

/// Return the share of contacts per face, and check that the contacts are on their faces.
std::vector<double> DrawnShares(const object::Object& object, int draws) {
  const SurfaceSampler sampler(object);
  RandomStream random(4, RandomUse::kStart);
  std::vector<double> shares(object.face_count(), 0);
  for (int i = 0; i < draws; ++i) {
    const grasp::Contact contact = sampler.DrawAnywhere(random);
    EXPECT_LT((object.ClosestPoint(contact.face, contact.p) - contact.p).norm(), 1e-12);
    EXPECT_EQ(contact.n, object.inward_normal(contact.face));
    shares[contact.face] += 1.0 / draws;
  }
  return shares;
}

void ExpectSharesOfTheMeasure(const object::Object& object) {
  const std::vector<double> shares = DrawnShares(object, 4000);
  const double whole = SurfaceSampler(object).measure();
  double sum = 0;
  for (FaceIndex face{0}; face < object.face_count(); ++face) {
    sum += object.face_measure(face);
    // The tolerance is at least four standard deviations.
    EXPECT_NEAR(shares[face], object.face_measure(face) / whole, 0.032) << "face " << face;
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
}

object::Polygon MakeNotched() {
  return object::Polygon::FromRings({{{0, 0}, {4, 0}, {4, 2}, {1, 2}, {1, 1}, {0.5, 3}, {0, 3}}},
                                    "notched");
}

TEST(SurfaceSampler, DrawsEvenlyOverFacesInSpaceAndInThePlane) {
  ExpectSharesOfTheMeasure(MakeBox({0.1, 0.06, 0.03}, 3));
  ExpectSharesOfTheMeasure(MakeNotched());
}

TEST(SurfaceSampler, DrawsFacetsByTheirMeasure) {
  const object::Polygon polygon = MakeNotched();
  const SurfaceSampler sampler(polygon);
  RandomStream random(4, RandomUse::kStart);
  int first = 0;
  for (int i = 0; i < 1000; ++i) first += sampler.DrawTriangle(random) == 0 ? 1 : 0;
  EXPECT_NEAR(first / 1000.0, 4 / sampler.measure(), 0.06);
}

TEST(SurfaceSampler, DrawsValidContactsAwayFromBordersAndCorners) {
  const object::Polygon polygon = MakeNotched();
  const SurfaceSampler sampler(polygon, 0.2);
  RandomStream random(4, RandomUse::kStart);
  int invalid = 0;
  for (int i = 0; i < 300; ++i) {
    const grasp::Contact contact = sampler.Draw(random);
    EXPECT_TRUE(sampler.IsValid(contact));
    EXPECT_TRUE(criteria::HasClearance(polygon, contact));
    EXPECT_GE(polygon.DistanceToBorder(contact.face, contact.p),
              SurfaceSampler::kFromBorder * polygon.diameter());
    EXPECT_EQ(sampler.DrawOn(FaceIndex(2), random).face, 2);
    if (!sampler.IsValid(sampler.DrawAnywhere(random))) ++invalid;
  }
  EXPECT_GT(invalid, 5);
}

TEST(SurfaceSampler, SaysWhereNothingIsValid) {
  const object::Polygon polygon = MakeNotched();
  RandomStream random(4, RandomUse::kStart);
  EXPECT_TRUE(SurfaceSampler(polygon).TryDraw(random));
  // No point of an edge is as far from its border as the polygon's width.
  const SurfaceSampler none(polygon, 0, 1);
  EXPECT_FALSE(none.TryDraw(random));
  EXPECT_FALSE(none.IsValid(none.Draw(random)));
}

/// Return a rod along z with a regular cross-section; lengths are in metres.
object::Polyhedron MakeRod(int sides, double diameter, double length) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    outline.emplace_back(diameter / 2 * std::cos(angle), diameter / 2 * std::sin(angle));
  }
  return object::Polyhedron::FromSoup(Extrude(outline, 0, length), "rod");
}

constexpr double kClearance = 0.02;

TEST(SurfaceSampler, ThinSidesKeepTheirShareOfContactsWhateverTheirNumber) {
  for (const int sides : {3, 4, 6, 7, 9, 10, 12, 16, 20, 48, 200}) {
    for (const double diameter : {0.015, 0.004}) {
      const object::Polyhedron rod = MakeRod(sides, diameter, 0.12);
      const SurfaceSampler sampler(rod, 0, kClearance);
      RandomStream random(4, RandomUse::kContactPoints);
      std::set<FaceIndex> faces;
      int on_sides = 0;
      for (int i = 0; i < 400; ++i) {
        const auto contact = sampler.TryDraw(random);
        ASSERT_TRUE(contact) << sides;
        EXPECT_GE(rod.DistanceToBorder(contact->face, contact->p),
                  SurfaceSampler::kFromBorder * rod.diameter());
        if (std::abs(contact->n.z()) > 0.5) continue;
        ++on_sides;
        faces.insert(contact->face);
      }
      // The ends are less than 6 % of the surface.
      EXPECT_GT(on_sides, 320) << sides << " sides, diameter " << diameter;
      EXPECT_GT(faces.size(), std::min(sides, 60) * 0.8) << sides;
    }
  }
}

TEST(SurfaceSampler, ContactsKeepTheClearanceFromSharpEdgesAndMayBeBesideNearlyFlatOnes) {
  const object::Polyhedron cube = MakeCube();
  // The sides are 18.8 mm wide, and their normals differ by 18 degrees.
  const object::Polyhedron drum = MakeRod(20, 0.12, 0.12);
  for (const object::Polyhedron* solid : {&cube, &drum}) {
    const SurfaceSampler sampler(*solid, 0, kClearance);
    const double clearance = kClearance * solid->diameter();
    RandomStream random(4, RandomUse::kContactPoints);
    int beside = 0;
    for (int i = 0; i < 600; ++i) {
      const grasp::Contact contact = sampler.Draw(random);
      const double distance = solid->DistanceToBorder(contact.face, contact.p);
      if (distance >= clearance) continue;
      ++beside;
      EXPECT_LT(std::abs(contact.n.z()), 0.5);
      EXPECT_GE(contact.p.z(), clearance);
      EXPECT_LE(contact.p.z(), 0.12 - clearance);
    }
    EXPECT_EQ(beside > 0, solid == &drum) << beside;
  }
}

}  // namespace surface_sampler_test
}  // namespace regrasp::sampling
