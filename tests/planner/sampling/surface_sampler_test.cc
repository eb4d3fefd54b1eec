#include "planner/sampling/surface_sampler.h"

#include <gtest/gtest.h>

#include <vector>

#include "planner/criteria/clearance.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/solids.h"

namespace regrasp::sampling {
namespace surface_sampler_test {

/// Shares of the faces in contacts drawn anywhere, which lie on their faces.
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
    // Four standard deviations at most.
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
  // No point of an edge is as far from its border as the polygon is wide.
  const SurfaceSampler none(polygon, 0, 1);
  EXPECT_FALSE(none.TryDraw(random));
  EXPECT_FALSE(none.IsValid(none.Draw(random)));
}

}  // namespace surface_sampler_test
}  // namespace regrasp::sampling
