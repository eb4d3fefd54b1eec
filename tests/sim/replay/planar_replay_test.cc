#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "planner/base/error.h"
#include "planner/grasp/required_friction_angle.h"
#include "sim/replay/replay.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay/replay_expectations.h"

namespace regrasp::sim {
namespace planar_replay_test {

TEST(PlanarHold, TwoAntipodalFingersHoldASquare) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp grasp = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)};
  ExpectGood(ReplayPlan(square, MakePlanarPlan(grasp, 20), {}), 1);
}

TEST(PlanarHold, ThreeFingersHoldATriangleAtTheMiddlesOfItsEdges) {
  const object::Polygon triangle = MakeTriangle(0.08);
  const plan::FingerGrasp grasp = {OnEdge(triangle, 0, 0, 0.5), OnEdge(triangle, 1, 1, 0.5),
                                   OnEdge(triangle, 2, 2, 0.5)};
  ExpectGood(ReplayPlan(triangle, MakePlanarPlan(grasp, 20), {}), 1);
}

TEST(PlanarHold, LosesTheSameGraspsBelowTheirCriticalFriction) {
  const object::Polygon square = MakeSquare(0.03), triangle = MakeTriangle(0.08);
  // Antipodal contacts 3 mm off the normal: atan(1/20) = 2.86 degrees.
  const plan::FingerGrasp pair = {OnEdge(square, 0, 1, 0.525), OnEdge(square, 1, 3, 0.525)};
  EXPECT_TRUE(LosesObject(ReplayPlan(square, MakePlanarPlan(pair, 2.6), {}).steps.at(0).reason));
  EXPECT_EQ(ReplayPlan(square, MakePlanarPlan(pair, 4.3), {}).steps.at(0).reason,
            plan::Reason::kNone);
  // Three normals with moments of the same sign about the centre.
  const plan::FingerGrasp twisted = {OnEdge(triangle, 0, 0, 0.6), OnEdge(triangle, 1, 1, 0.6),
                                     OnEdge(triangle, 2, 2, 0.6)};
  const double critical =
      grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(twisted), triangle.wrench_frame())
          .value()
          .upper;
  EXPECT_GT(critical, Radians(5));
  EXPECT_TRUE(LosesObject(ReplayPlan(triangle, MakePlanarPlan(twisted, 0.9 * Degrees(critical)), {})
                              .steps.at(0)
                              .reason));
  EXPECT_EQ(
      ReplayPlan(triangle, MakePlanarPlan(twisted, 1.5 * Degrees(critical)), {}).steps.at(0).reason,
      plan::Reason::kNone);
}

/// Switches of two fingers for two, of one finger added, one removed, and one for another.
plan::Plan SquareSwitches(const object::Polygon& square) {
  plan::Plan plan = MakePlanarPlan({OnEdge(square, 0, 1, 0.45), OnEdge(square, 1, 3, 0.5)}, 20);
  plan.steps = {
      plan::Switch{{OnEdge(square, 2, 0, 0.4), OnEdge(square, 3, 2, 0.55)},
                   {FingerIndex(0), FingerIndex(1)}},
      plan::Switch{{OnEdge(square, 0, 0, 0.7)}, {}},
      plan::Switch{{OnEdge(square, 1, 2, 0.2)}, {FingerIndex(3)}},
      plan::Switch{{OnEdge(square, 3, 2, 0.8)}, {FingerIndex(1)}},
  };
  return plan;
}

TEST(PlanarSwitch, PlacesAndReleasesOneTwoOrNoFingersAtOnce) {
  const object::Polygon square = MakeSquare(0.03);
  ExpectGood(ReplayPlan(square, SquareSwitches(square), {}), 5);
}

TEST(PlanarSwitch, FailsWhereACarryingFingerLeaves) {
  const object::Polygon square = MakeSquare(0.03);
  plan::Plan plan = SquareSwitches(square);
  // Contacts below and above are force closure; neighbouring contacts are not.
  plan.steps = {plan::Switch{{OnEdge(square, 2, 0, 0.4), OnEdge(square, 3, 2, 0.55)},
                             {FingerIndex(0), FingerIndex(2)}}};
  const ReplayResult result = ReplayPlan(square, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_TRUE(LosesObject(result.steps[1].reason)) << plan::ReasonName(result.steps[1].reason);
}

TEST(PlanarSwitch, FailsWhereTheNewGraspNeedsMoreFriction) {
  const object::Polygon square = MakeSquare(0.03);
  plan::Plan plan = SquareSwitches(square);
  // 24 mm off the normal at a distance of 60 mm: 21.8 degrees.
  plan.steps = {plan::Switch{{OnEdge(square, 2, 0, 0.3), OnEdge(square, 3, 2, 0.7)},
                             {FingerIndex(0), FingerIndex(1)}}};
  EXPECT_EQ(ReplayPlan(square, plan, {}).steps.at(1).reason, plan::Reason::kNone);
  plan.steps = {plan::Switch{{OnEdge(square, 2, 0, 0.3), OnEdge(square, 3, 2, 0.3)},
                             {FingerIndex(0), FingerIndex(1)}}};
  EXPECT_TRUE(LosesObject(ReplayPlan(square, plan, {}).steps.at(1).reason));
}

TEST(PlanarConcave, TouchesBothEdgesOfAnInnerCorner) {
  const object::Polygon l = MakeL();
  plan::Plan plan = MakePlanarPlan({OnEdge(l, 0, 2, 0.9), OnEdge(l, 1, 0, 0.6)}, 20);
  // 0.4 and 0.04 mm from the corner, closer than the usual radius of a fingertip.
  plan.steps = {
      plan::Switch{{OnEdge(l, 2, 3, 0.01), OnEdge(l, 3, 5, 0.6)}, {FingerIndex(0), FingerIndex(1)}},
      plan::Switch{{OnEdge(l, 0, 2, 0.999), OnEdge(l, 1, 0, 0.5)},
                   {FingerIndex(2), FingerIndex(3)}}};
  const ReplayResult result = ReplayPlan(l, plan, {});
  ExpectGood(result, 3);
  EXPECT_LT(result.settings.fingertip_radius_m, 0.00003);
  ExpectTouchesAsPlanned(l, plan, result);
}

TEST(PlanarConcave, CannotBeHeldInTheInnerCornerItself) {
  const object::Polygon l = MakeL();
  const plan::FingerGrasp good = {OnEdge(l, 0, 2, 0.9), OnEdge(l, 1, 0, 0.6)};
  for (const double share : {0.9999999, 1.0}) {
    const plan::FingerContact corner = OnEdge(l, 2, 2, share);
    const ReplayResult hold = ReplayPlan(l, MakePlanarPlan({corner, OnEdge(l, 1, 0, 0.5)}, 20), {});
    EXPECT_EQ(hold.steps.at(0).reason, plan::Reason::kUnreachable);
    EXPECT_NE(hold.steps.at(0).detail.find("finger 2 does not fit"), std::string::npos);
    plan::Plan plan = MakePlanarPlan(good, 20);
    plan.steps = {plan::Switch{{corner, OnEdge(l, 3, 0, 0.5)}, {FingerIndex(0), FingerIndex(1)}}};
    const ReplayResult result = ReplayPlan(l, plan, {});
    ASSERT_EQ(result.steps.size(), 2u);
    EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone) << result.steps[0].detail;
    EXPECT_EQ(result.steps[1].reason, plan::Reason::kUnreachable);
  }
}

TEST(PlanarHole, IsHeldFromInsideAndThroughItsWall) {
  const object::Polygon frame = MakeFrame();
  // Fingers press outwards in the hole: edges 4 and 6 are its left and right.
  plan::Plan plan = MakePlanarPlan({OnEdge(frame, 0, 4, 0.45), OnEdge(frame, 1, 6, 0.5)}, 15);
  // Afterwards the wall below is pinched between hole and outside.
  plan.steps = {plan::Switch{{OnEdge(frame, 2, 7, 0.6), OnEdge(frame, 3, 0, 0.45)},
                             {FingerIndex(0), FingerIndex(1)}}};
  const ReplayResult result = ReplayPlan(frame, plan, {});
  ExpectGood(result, 2);
  ExpectTouchesAsPlanned(frame, plan, result);
}

TEST(PlanarHole, IsLostWhereItsFingersPressBesideEachOther) {
  const object::Polygon frame = MakeFrame();
  const plan::FingerGrasp grasp = {OnEdge(frame, 0, 4, 0.2), OnEdge(frame, 1, 6, 0.2)};
  EXPECT_TRUE(LosesObject(ReplayPlan(frame, MakePlanarPlan(grasp, 15), {}).steps.at(0).reason));
}

/// Return all measurements of a replay, in diameters and radians.
std::vector<double> Measure(const object::Polygon& polygon, const plan::Plan& plan,
                            const ReplayOptions& options) {
  const ReplayResult result = ReplayPlan(polygon, plan, options);
  const double D = result.settings.diameter_m;
  std::vector<double> measured;
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
    measured.insert(measured.end(), {step.displacement_m / D, Radians(step.rotation_deg),
                                     step.slip_m / D, step.drift_m / D});
  }
  return measured;
}

void ExpectEqualUpToRounding(const std::vector<double>& a, const std::vector<double>& b) {
  // Static contacts have a penetration of 1e-7 D, with an error of 1e-9 D.
  constexpr double kRounding = 1e-10;
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0u);
  EXPECT_GT(*std::max_element(a.begin(), a.end()), 100 * kRounding);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], kRounding) << i;
}

TEST(PlanarScale, MotionDoesNotDependOnTheThickness) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Plan plan = SquareSwitches(square);
  const auto measure = [&](double thickness, std::optional<double> mass) {
    ReplayOptions options;
    options.thickness = thickness;
    options.mass_kg = mass;
    return Measure(square, plan, options);
  };
  const std::vector<double> usual = measure(0.02, std::nullopt);
  ExpectEqualUpToRounding(usual, measure(0.002, std::nullopt));
  ExpectEqualUpToRounding(usual, measure(0.3, std::nullopt));
  ExpectEqualUpToRounding(usual, measure(0.002, 0.1));
}

TEST(PlanarScale, TheMassIsThatOfThePrism) {
  const object::Polygon frame = MakeFrame();
  plan::Plan plan = MakePlanarPlan({OnEdge(frame, 0, 4, 0.45), OnEdge(frame, 1, 6, 0.5)}, 15);
  ReplayOptions options;
  options.density_kg_m3 = 500;
  const double area = 0.08 * 0.08 - 0.04 * 0.04;
  const ReplaySettings usual = ReplayPlan(frame, plan, options, {}, 1).settings;
  EXPECT_NEAR(usual.thickness_m, 0.25 * frame.diameter(), 1e-15);
  EXPECT_NEAR(usual.mass_kg, 500 * area * usual.thickness_m, 1e-12);
  EXPECT_EQ(usual.gravity_m_s2, 0);
  options.thickness = 0.01;
  EXPECT_NEAR(ReplayPlan(frame, plan, options, {}, 1).settings.mass_kg, 500 * area * 0.01, 1e-12);
}

TEST(PlanarScale, MillimetresWithAScaleAreMetres) {
  const object::Polygon square = MakeSquare(0.03);
  const object::Polygon big = object::Polygon::FromWkt(
      "POLYGON((-30 -30, 30 -30, 30 30, -30 30, -30 -30))", "in millimetres");
  plan::Plan millimetres = SquareSwitches(big);
  millimetres.scale = 1e-3;
  ReplayOptions thick, thick_in_millimetres;
  thick.thickness = 0.013;
  thick_in_millimetres.thickness = 13;
  ExpectEqualUpToRounding(Measure(square, SquareSwitches(square), thick),
                          Measure(big, millimetres, thick_in_millimetres));
  const auto settings = [](const object::Polygon& polygon, const plan::Plan& plan,
                           const ReplayOptions& options) {
    return ReplayPlan(polygon, plan, options, {}, 1).settings;
  };
  EXPECT_NEAR(settings(square, SquareSwitches(square), thick).grasp_force_N,
              settings(big, millimetres, thick_in_millimetres).grasp_force_N, 1e-9);
}

TEST(PlanarScale, ReplaysBodiesFromMilligramsToTonnes) {
  const object::Polygon square = MakeSquare(0.03);
  plan::Plan plan = SquareSwitches(square);
  for (const auto& [scale, density] :
       {std::pair{0.1, 1000.0}, {1.0, 100.0}, {1.0, 8000.0}, {10.0, 8000.0}}) {
    SCOPED_TRACE(scale);
    plan.scale = scale;
    ReplayOptions options;
    options.density_kg_m3 = density;
    ExpectGood(ReplayPlan(square, plan, options), 5);
  }
}

TEST(PlanarScale, RefusesThicknessesThatCannotBeSimulatedAndThatOfASolid) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Plan plan = SquareSwitches(square);
  ReplayOptions options;
  for (const double thickness : {0.0, -0.01, 1e-6, 1e3}) {
    options.thickness = thickness;
    EXPECT_THROW((void)ReplayPlan(square, plan, options), InputError);
  }
  const CubeCase cube;
  options.thickness = 0.01;
  EXPECT_THROW((void)ReplayPlan(cube.object, MakePlan(cube.Start(), 25), options), InputError);
}

TEST(PlanarReplay, TheSamePlanGivesTheSameBits) {
  const object::Polygon square = MakeSquare(0.03);
  ExpectSameBitsTwice(square, SquareSwitches(square));
}

TEST(PlanarReplay, NothingLeavesThePlane) {
  const object::Polygon square = MakeSquare(0.03);
  const ReplayResult result = ReplayPlan(square, SquareSwitches(square), {});
  int checked = 0;
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.snapshot.X_WO.translation().z(), 0);
    EXPECT_EQ(step.snapshot.X_WO.linear()(2, 2), 1);
    for (const plan::FingerState& state : step.snapshot.fingers) {
      EXPECT_EQ(state.tip_W.z(), 0);
      EXPECT_EQ(state.contact_W.z(), 0);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 20);
}

}  // namespace planar_replay_test
}  // namespace regrasp::sim
