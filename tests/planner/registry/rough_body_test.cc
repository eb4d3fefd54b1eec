// Planners on objects whose triangles differ from the surface that a fingertip feels, such as
// scans.

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/soups.h"

namespace regrasp::registry {
namespace rough_body_test {

constexpr double kPatch = 0.15;
constexpr double kRoughness_deg = 5;
constexpr double kFrictionAngle_deg = 20;

/// Return a sphere of radius 1 with triangles whose normals deviate by up to 30°.
object::Polyhedron RoughSphere(bool felt) {
  object::PolygonSoup sphere = soups::SphereSoup(30);
  for (std::size_t v = 0; v < sphere.vertices.size(); ++v) {
    sphere.vertices[v] *= 1 + 0.03 * std::sin(12.9898 * double(v) * double(v));
  }
  object::Reading reading;
  if (felt) reading.patch = object::FeltPatch{kPatch, Radians(kRoughness_deg)};
  return object::Polyhedron::FromSoup(sphere, "soup", reading);
}

planning::PlanResult PlanOn(const object::Polyhedron& body, const planning::Planner& planner,
                            double friction_angle_deg, std::uint64_t seed) {
  planning::PlanRequest request;
  request.object = &body;
  request.criteria.friction_angle = Radians(friction_angle_deg);
  request.seed = seed;
  request.start = {planning::GraspChoice::Kind::kRandomAny, {}, "start"};
  request.goal = {planning::GraspChoice::Kind::kRandomAny, {}, "goal"};
  return planning::Solve(planner, request);
}

/// Return whether a plan passes the checker's test of contact patches.
bool HoldsWithPatches(const object::Polyhedron& body, plan::Plan plan) {
  plan.friction_angle = Radians(kFrictionAngle_deg);
  plan.patch_radius = kPatch;
  return plan::CheckPlan(body, plan).passed();
}

class RoughBody : public ::testing::TestWithParam<const char*> {};

TEST_P(RoughBody, TakesNoFingersWhereItIsRoughAndPlansHoldWithThePatchesNormals) {
  const object::Polyhedron body = RoughSphere(true);
  int rests = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const planning::PlanResult result =
        PlanOn(body, *FindPlanner(GetParam()), kFrictionAngle_deg - kRoughness_deg, seed);
    if (!result.plan) continue;
    EXPECT_TRUE(HoldsWithPatches(body, *result.plan)) << seed;
    for (const grasp::Grasp& rest : RestsOf(plan::ProjectPlan(body, *result.plan))) {
      for (const grasp::Contact& contact : rest) {
        EXPECT_FALSE(body.IsRough(contact.face, contact.p)) << seed;
      }
      ++rests;
    }
  }
  EXPECT_GT(rests, 10);
}

INSTANTIATE_TEST_SUITE_P(Planners, RoughBody, ::testing::Values("general", "roadmap"),
                         [](const auto& info) { return std::string(info.param); });

TEST(RoughBodyControl, WithoutALookAtPatchesSomePlansLoseAGrasp) {
  const object::Polyhedron body = RoughSphere(false);
  int found = 0;
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const planning::PlanResult result =
        PlanOn(body, *FindPlanner("general"), kFrictionAngle_deg, seed);
    if (!result.plan) continue;
    ++found;
    lost += HoldsWithPatches(body, *result.plan) ? 0 : 1;
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(lost, 0);
}

}  // namespace rough_body_test
}  // namespace regrasp::registry
