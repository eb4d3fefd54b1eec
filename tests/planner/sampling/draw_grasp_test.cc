#include "planner/sampling/draw_grasp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/project_path.h"
#include "tests/fixtures/solids.h"

namespace regrasp::sampling {
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
    if (++draws == 10) throw NoGrasp{"the time was up"};
  };
  EXPECT_EQ(Refusal([&] { (void)DrawOnSurface(cube, kFour, evaluator, random, "start", stop); }),
            "the time was up");
}

}  // namespace draw_grasp_test
}  // namespace regrasp::sampling
