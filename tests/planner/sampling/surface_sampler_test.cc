#include "planner/sampling/surface_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <vector>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/project_path.h"
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

namespace draw_grasp_test {

constexpr grasp::ContactLimits kFour = {4, 4};

/// Return the message of NoGrasp; empty if none is thrown.
std::string Refusal(const std::function<void()>& draw) {
  try {
    draw();
  } catch (const NoGrasp& none) {
    return none.message;
  }
  return "";
}

TEST(DrawOnSurface, DrawsNoTwoContactsOnATriangleWhoseEdgesAreNotOpposedEnough) {
  // The normals of an equilateral triangle's edges are 60 degrees from opposite. Two contacts
  // therefore require a friction angle of more than 30 degrees.
  const object::ObjectFile file = object::ReadObject(ProjectPath("models/triangle.wkt"));
  const object::Object& triangle = *file.object;
  for (const double degrees : {5.0, 25.0, 29.9, 31.0, 50.0}) {
    const criteria::GraspEvaluator evaluator(triangle, {Radians(degrees), 0});
    RandomStream random(3, RandomUse::kStart);
    RandomStream same(3, RandomUse::kStart);
    const std::string refusal = Refusal([&] {
      (void)DrawOnSurface(triangle, {2, 2}, evaluator, random, "start");
    });
    EXPECT_EQ(refusal.empty(), degrees > 30) << degrees;
    if (refusal.empty()) continue;
    // Only the number of contacts was drawn.
    (void)same.Index(1);
    EXPECT_EQ(random.Uniform(), same.Uniform());
    EXPECT_EQ(DrawOnSurface(triangle, {2, 3}, evaluator, random, "start").size(), 3U);
  }
}

TEST(DrawOnSurface, GivesGoodForceClosureGraspsEvenlyOverTheFaces) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  const criteria::GraspEvaluator evaluator(cube, {Radians(20), 0.02});
  RandomStream random(1, RandomUse::kStart);
  std::vector<int> on_face(cube.face_count(), 0);
  constexpr int kGrasps = 48;
  for (int i = 0; i < kGrasps; ++i) {
    const grasp::Grasp grasp = DrawOnSurface(cube, kFour, evaluator, random, "start");
    ASSERT_EQ(grasp.size(), 4u);
    EXPECT_TRUE(grasp::IsForceClosure(grasp, cube.wrench_frame(), Radians(20)));
    EXPECT_GE(grasp::ComputeQuality(grasp, cube.wrench_frame(), Radians(20)).upper, 0.02);
    for (const grasp::Contact& contact : grasp) ++on_face[contact.face];
  }
  // Each face has a sixth of the contacts by symmetry. The bound is wide because the contacts of
  // one grasp are dependent.
  for (const int count : on_face) EXPECT_NEAR(count, 4 * kGrasps / 6, 4 * kGrasps / 12);
}

TEST(DrawOnSurface, SaysInTheSameWordsThatNoGraspIsThatGood) {
  // No grasp resists more than its grasp force.
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  const object::ObjectFile square = object::ReadObject(ProjectPath("models/square.wkt"));
  RandomStream random(1, RandomUse::kStart);
  const auto refusal = [&](const object::Object& object, const grasp::ContactLimits& contacts) {
    const criteria::GraspEvaluator evaluator(object, {Radians(5), 1.1});
    return Refusal([&] { (void)DrawOnSurface(object, contacts, evaluator, random, "start"); });
  };
  EXPECT_EQ(refusal(cube, kFour),
            "start: none of 200000 grasps of 4 contacts drawn on the surface is force closure with "
            "a quality of at least 1.1");
  EXPECT_EQ(refusal(*square.object, {2, 3}),
            "start: none of 200000 grasps of 2 and as many of 3 contacts drawn on the surface is "
            "force closure with a quality of at least 1.1");
}

TEST(DrawOnSurface, SaysThatFingersReachNothing) {
  // Saw blade: a sphere much larger than the teeth that touches the side of a tooth enters the next
  // one.
  std::vector<Eigen::Vector2d> ring;
  constexpr int kTeeth = 40;
  for (int i = 0; i < 2 * kTeeth; ++i) {
    const double angle = std::numbers::pi * i / kTeeth;
    ring.push_back((i % 2 == 0 ? 1.0 : 0.9) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const object::Polygon saw = object::Polygon::FromRings({ring}, "saw");
  RandomStream random(1, RandomUse::kStart);
  const criteria::GraspEvaluator thick(saw, {Radians(30), 0}, {.fingertip_radius = 0.5});
  EXPECT_EQ(Refusal([&] {
              (void)DrawOnSurface(saw, {2, 3}, thick, random, "start");
            }),
            "start: a finger of radius 0.5 reaches none of 1000 points drawn on the surface");
  const criteria::GraspEvaluator thin(saw, {Radians(30), 0}, {.fingertip_radius = 0.001});
  const grasp::Grasp grasp = DrawOnSurface(saw, {2, 3}, thin, random, "start");
  EXPECT_TRUE(thin.IsGood(grasp));
  EXPECT_FALSE(thick.IsGood(grasp));
}

TEST(DrawOnSurface, MakesAnEndWhereItIsTold) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  const criteria::GraspEvaluator evaluator(cube, {Radians(5), 1.1});
  RandomStream random(1, RandomUse::kStart);
  int draws = 0;
  const auto stop = [&] {
    if (++draws == 10) throw NoGrasp{"time limit reached"};
  };
  EXPECT_EQ(Refusal([&] { (void)DrawOnSurface(cube, kFour, evaluator, random, "start", stop); }),
            "time limit reached");
}

}  // namespace draw_grasp_test
}  // namespace regrasp::sampling
