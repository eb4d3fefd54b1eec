// Sequences of soft fingers, two of which can hold a solid.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/error.h"
#include "planner/plan/check.h"
#include "planner/registry/registry.h"
#include "planner/tree/face_align.h"
#include "planner/tree/tree_planner.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace soft_fingers_test {

using testing::HasSubstr;
using Status = planning::PlanResult::Status;

constexpr double kTorsion = 0.01;

planning::PlanRequest SoftAt(double degrees, std::uint64_t seed = 0) {
  planning::PlanRequest request = RequestAt(degrees, seed);
  request.hand.torsion = kTorsion;
  return request;
}

/// Return two fingers on opposite faces of models/cube.obj, across `axis`.
grasp::Grasp PairAcross(const object::Object& cube, int axis, double off = 0) {
  grasp::Grasp grasp;
  for (const double side : {-1.0, 1.0}) {
    grasp::Contact contact;
    contact.p = Eigen::Vector3d::Constant(side * off);
    contact.p[axis] = 0.03 * side;
    contact.n[axis] = -side;
    for (const FaceIndex face : cube.FacesNear(contact.p, 1e-6)) {
      if (cube.inward_normal(face).dot(contact.n) > 0.99) contact.face = face;
    }
    grasp.push_back(contact);
  }
  return grasp;
}

int CountPairs(const plan::Plan& plan) {
  int pairs = 0;
  for (const grasp::Grasp& rest : RestsOf(plan)) pairs += rest.size() == 2 ? 1 : 0;
  return pairs;
}

TEST(SoftFingersPlan, TwoFingersTakeOverFromTwo) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const grasp::Grasp start = PairAcross(*file.object, 0), goal = PairAcross(*file.object, 1);
  const planning::PlanResult result =
      PlanWith(TreePlanner(), *file.object, Given(start), Given(goal), SoftAt(25));
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  EXPECT_EQ(result.plan->torsion, kTorsion);
  EXPECT_GE(CountPairs(*result.plan), 2);
  EXPECT_GT(result.margin, 0);
  ExpectGoodPlan(TreePlanner(), *file.object, result, start, goal);
  // The same steps are invalid for hard contacts.
  plan::CheckOptions hard;
  hard.torsion = 0;
  EXPECT_FALSE(plan::CheckPlan(*file.object, *result.plan, hard).passed());
}

TEST(SoftFingersPlan, TwoFingersSlideWithAProofOfTheirTorques) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const auto align_of = [&](double torsion) {
    SearchSpace space(*file.object, {Radians(30), 0}, {.torsion = torsion});
    const auto from = Take(PairAcross(*file.object, 0), space);
    return AlignBetween(from, Take(PairAcross(*file.object, 0, 0.004), space), space);
  };
  const auto soft = align_of(kTorsion);
  ASSERT_TRUE(soft);
  ASSERT_FALSE(soft->proof.empty());
  EXPECT_EQ(soft->proof.front().front().start_torques.size(), 2U);
  EXPECT_FALSE(align_of(0));
}

TEST(SoftFingersPlan, RandomGraspsAreJoinedAndTheCheckerPasses) {
  for (const char* model : {"cube.obj", "hole_block.obj"}) {
    const object::ObjectFile file = ReadModel(model);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const planning::PlanResult result =
          PlanWith(TreePlanner(), *file.object, Random(), Random(), SoftAt(15, seed));
      ASSERT_EQ(result.status, Status::kFound) << result.message;
      ExpectGoodPlan(TreePlanner(), *file.object, result);
    }
  }
}

TEST(SoftFingersPlan, HardPointsPlannersAndThePlaneRefuse) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const grasp::Grasp pair = PairAcross(*file.object, 0);
  const auto complaint = [&](const object::Object& object, const std::string& planner,
                             planning::PlanRequest request) -> std::string {
    request.object = &object;
    request.start = request.goal = Given(pair);
    try {
      static_cast<void>(planning::Solve(registry::PlannerFor(planner, request), request));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint(*file.object, "general", RequestAt(25)), HasSubstr("found 2"));
  EXPECT_THAT(complaint(*file.object, "polyhedron", SoftAt(25)),
              HasSubstr("--contact soft: not supported by planner polyhedron"));
  EXPECT_THAT(complaint(*ReadModel("polygon15.wkt").object, "auto", SoftAt(25)),
              HasSubstr("--contact soft"));
  // The offset from the line is too large for 10°.
  const grasp::Grasp off = {pair[0], PairAcross(*file.object, 0, 0.02)[1]};
  planning::PlanRequest request = SoftAt(10);
  request.object = file.object.get();
  request.start = request.goal = Given(off);
  EXPECT_THAT(
      [&] { static_cast<void>(planning::Solve(TreePlanner(), request)); },
      testing::ThrowsMessage<InputError>(HasSubstr("not force closure: requires a friction")));
}

}  // namespace soft_fingers_test
}  // namespace regrasp::tree
