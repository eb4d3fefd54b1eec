// Tests of the second engine, which must give the same verdicts on the same plans.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "sim/replay/disagreement.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay/replay_expectations.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace engines_test {

ReplayOptions By(EngineChoice engine) {
  ReplayOptions options;
  options.engine = engine;
  return options;
}

const ReplayOptions kOde = By(EngineChoice::kOde);
const ReplayOptions kBoth = By(EngineChoice::kBoth);

plan::Plan CubeSwitches(const CubeCase& cube, double friction_angle_deg) {
  plan::Plan plan = MakePlan(cube.Start(), friction_angle_deg);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}},
                plan::Switch{{cube.At(2, 0.002, 0.003, -0.03)}, {FingerIndex(3)}}};
  return plan;
}

TEST(OdeReplay, HoldsAGoodGraspAndLosesItBelowItsRequiredFriction) {
  const CubeCase cube;
  ExpectGood(ReplayPlan(cube.object, MakePlan(cube.Start(), 25), kOde), 1);
  // The grasp requires 5.3°.
  const ReplayResult lost = ReplayPlan(cube.object, MakePlan(cube.Start(), 4), kOde);
  EXPECT_TRUE(LosesObject(lost.steps.at(0).reason)) << plan::ReasonName(lost.steps[0].reason);
}

TEST(OdeReplay, CarriesOutSwitches) {
  const CubeCase cube;
  const ReplayResult result = ReplayPlan(cube.object, CubeSwitches(cube, 25), kOde);
  ExpectGood(result, 3);
  EXPECT_EQ(result.settings.engine, EngineChoice::kOde);
}

TEST(OdeReplay, LosesTheObjectWhereACarryingFingerLeaves) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  // Fingers 0 and 2 remain, on two neighbouring faces.
  plan.steps = {plan::Switch{{}, {FingerIndex(1), FingerIndex(3)}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, kOde);
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_TRUE(LosesObject(result.steps[1].reason)) << plan::ReasonName(result.steps[1].reason);
}

TEST(OdeReplay, SlidesAndImitatesAlignsInThePlane) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 0, 0.4)};
  plan::FingerGrasp moved = start;
  moved[2].contact = OnEdge(square, 0, 0.6);
  for (const AlignChoice choice : {AlignChoice::kImitate, AlignChoice::kSlide}) {
    plan::Plan plan = MakePlanarPlan(start, 15);
    plan.steps = {plan::Align{{start, moved}}};
    ReplayOptions options = kOde;
    options.align = choice;
    const ReplayResult result = ReplayPlan(square, plan, options);
    ASSERT_EQ(result.steps.size(), 2u);
    for (const StepReplay& step : result.steps) {
      EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
    }
    EXPECT_EQ(result.steps.back().align_mode,
              choice == AlignChoice::kSlide ? AlignMode::kSlid : AlignMode::kImitated);
  }
}

TEST(OdeReplay, RollsFingersOfAHandThatNeedsThemAll) {
  const object::Polygon triangle = MakeTriangle(0.08);
  const auto at = [&](double share) {
    return plan::FingerGrasp{OnEdge(triangle, 0, 0, share), OnEdge(triangle, 1, 1, share),
                             OnEdge(triangle, 2, 2, share)};
  };
  plan::Plan plan = MakePlanarPlan(at(0.5), 15, 3);
  plan.steps = {plan::Align{{at(0.5), at(0.55)}}};
  ExpectGood(ReplayPlan(triangle, plan, kOde), 2);
}

TEST(OdeReplay, RollsFingersRoundACorner) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Align align = AroundTheCorner(square);
  plan::Plan plan = MakePlanarPlan(align.waypoints.front(), 10, 4);
  plan.steps = {align};
  ExpectGood(ReplayPlan(square, plan, kOde), 2);
}

TEST(OdeReplay, LosesTheObjectWhereAnAlignNeedsMoreFriction) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 0, 0.4)};
  plan::FingerGrasp end = start;
  end[0].contact = OnEdge(square, 1, 0.9);
  end[1].contact = OnEdge(square, 3, 0.9);
  // Fingers 0 and 1 end 48 mm apart along their edges.
  plan::Plan plan = MakePlanarPlan(start, 10, 3);
  plan.steps = {plan::Align{{start, end}}};
  const ReplayResult result = ReplayPlan(square, plan, kOde);
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone) << result.steps[0].detail;
  EXPECT_NE(result.steps[1].reason, plan::Reason::kNone);
}

TEST(OdeReplay, KnowsBothProtocols) {
  const CubeCase cube;
  ReplayOptions options = kOde;
  options.protocol = Protocol::kBoth;
  const StepReplay step = ReplayPlan(cube.object, MakePlan(cube.Start(), 25), options).steps.at(0);
  ASSERT_TRUE(step.adapted && step.fixed);
  EXPECT_EQ(step.adapted->reason, plan::Reason::kNone);
  EXPECT_EQ(step.fixed->reason, plan::Reason::kNone);
  // With fixed forces the servos yield under the disturbance force.
  EXPECT_GT(step.fixed->give_m, 10 * step.adapted->moved_m);
}

TEST(OdeReplay, SaysTheSameTwice) {
  const CubeCase cube;
  const ReplayResult a = ReplayPlan(cube.object, CubeSwitches(cube, 25), kOde);
  const ReplayResult b = ReplayPlan(cube.object, CubeSwitches(cube, 25), kOde);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    EXPECT_EQ(a.steps[k].moved_m, b.steps[k].moved_m);
    EXPECT_EQ(a.steps[k].drift_m, b.steps[k].drift_m);
    EXPECT_EQ(a.steps[k].static_margins, b.steps[k].static_margins);
  }
}

TEST(BothEngines, TheResultIsMujocosWithWhatOdeSaysBeside) {
  const CubeCase cube;
  const plan::Plan plan = CubeSwitches(cube, 25);
  const ReplayResult both = ReplayPlan(cube.object, plan, kBoth);
  const ReplayResult mujoco = ReplayPlan(cube.object, plan, {});
  const ReplayResult ode = ReplayPlan(cube.object, plan, kOde);
  EXPECT_EQ(both.settings.engine, EngineChoice::kBoth);
  ASSERT_EQ(both.steps.size(), mujoco.steps.size());
  for (std::size_t k = 0; k < both.steps.size(); ++k) {
    EXPECT_EQ(both.steps[k].moved_m, mujoco.steps[k].moved_m);
    ASSERT_TRUE(both.steps[k].ode);
    EXPECT_EQ(both.steps[k].ode->moved_m, ode.steps[k].moved_m);
    EXPECT_NE(both.steps[k].ode->moved_m, both.steps[k].moved_m) << "two engines";
    EXPECT_FALSE(mujoco.steps[k].ode);
  }
}

/// Return the number of grasps with equal verdicts of both engines, above and below their required
/// friction.
int CountAgreeing(const object::Object& body, int count,
                  const std::function<plan::FingerGrasp(std::mt19937&)>& draw) {
  constexpr unsigned kSeed = 2023;
  std::mt19937 random(kSeed);
  int compared = 0;
  while (compared < 2 * count) {
    const plan::FingerGrasp grasp = draw(random);
    const auto required =
        grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(grasp), body.wrench_frame());
    if (!required || required->upper > Radians(50) || required->upper < Radians(0.5)) continue;
    for (const double ratio : {0.95, 1.3}) {
      const double friction_angle = std::atan(ratio * std::tan(required->upper));
      const grasp::Grasp contacts = plan::ContactsOf(grasp);
      const double quality =
          grasp::ComputeQuality(contacts, body.wrench_frame(), friction_angle).lower;
      if (ratio > 1 && quality < kBoth.disturbance_ratio) continue;
      plan::Plan plan = MakePlan(grasp, Degrees(friction_angle), 4);
      plan.dimension = body.dimension();
      const StepReplay step = ReplayPlan(body, plan, kBoth).steps.at(0);
      EXPECT_EQ(step.reason == plan::Reason::kNone, ratio > 1) << step.detail;
      EXPECT_EQ(step.ode->reason == plan::Reason::kNone, ratio > 1) << step.ode->detail;
      ++compared;
    }
  }
  return compared;
}

TEST(BothEngines, AgreeOnRandomGraspsAboveAndBelowTheirCriticalFriction) {
  constexpr int kGrasps = 10;
  const object::ObjectFile file = ReadModel("stone.obj");
  const auto& stone = dynamic_cast<const object::Polyhedron&>(*file.object);
  const int solid = CountAgreeing(stone, kGrasps, [&](std::mt19937& random) {
    plan::FingerGrasp grasp;
    for (FingerIndex f{0}; f < 4; ++f) grasp.push_back({f, DrawContact(stone, random)});
    return grasp;
  });
  const object::Polygon l = MakeL();
  const int planar = CountAgreeing(l, kGrasps, [&](std::mt19937& random) {
    plan::FingerGrasp grasp;
    for (int f = 0; f < 3; ++f) grasp.push_back(DrawOnBoundary(l, f, random));
    return grasp;
  });
  EXPECT_GE(solid, 2 * kGrasps);
  EXPECT_GE(planar, 2 * kGrasps);
}

}  // namespace engines_test
}  // namespace regrasp::sim
