#include <gtest/gtest.h>

#include <cstring>

#include "planar_cases.h"
#include "planner/base/error.h"
#include "planner/grasp/required_half_angle.h"
#include "sim/replay.h"

namespace regrasp {
namespace {

/// What a good grasp may move or slide in a step, over the diameter: a tenth of the tolerance.
constexpr double kGood = 1e-4;

void ExpectGood(const ReplayResult& result, std::size_t entries) {
  ASSERT_EQ(result.steps.size(), entries);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << "entry " << step.index << ": " << step.detail;
    EXPECT_LT(step.displacement_m, kGood * result.settings.diameter_m);
    EXPECT_LT(step.slip_m, kGood * result.settings.diameter_m);
    EXPECT_LT(step.drift_m, kGood * result.settings.diameter_m);
    EXPECT_FALSE(step.contact_lost);
  }
}

bool LosesObject(Reason reason) {
  return reason == Reason::kContactLost || reason == Reason::kSlipped ||
         reason == Reason::kObjectMoved;
}

TEST(PlanarHold, TwoAntipodalFingersHoldASquare) {
  const Polygon square = MakeSquare();
  const FingerGrasp grasp = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)};
  ExpectGood(ReplayPlan(square, MakePlanarPlan(grasp, 20), {}), 1);
}

TEST(PlanarHold, ThreeFingersHoldATriangleAtTheMiddlesOfItsEdges) {
  const Polygon triangle = MakeTriangle();
  const FingerGrasp grasp = {OnEdge(triangle, 0, 0, 0.5), OnEdge(triangle, 1, 1, 0.5),
                             OnEdge(triangle, 2, 2, 0.5)};
  ExpectGood(ReplayPlan(triangle, MakePlanarPlan(grasp, 20), {}), 1);
}

TEST(PlanarHold, LosesTheSameGraspsBelowTheirCriticalFriction) {
  const Polygon square = MakeSquare(), triangle = MakeTriangle();
  // Antipodal contacts 3 mm off the normal: atan(1/20) = 2.86 degrees.
  const FingerGrasp pair = {OnEdge(square, 0, 1, 0.525), OnEdge(square, 1, 3, 0.525)};
  EXPECT_TRUE(LosesObject(ReplayPlan(square, MakePlanarPlan(pair, 2.6), {}).steps.at(0).reason));
  EXPECT_EQ(ReplayPlan(square, MakePlanarPlan(pair, 4.3), {}).steps.at(0).reason, Reason::kNone);
  // Three normals that turn the triangle the same way.
  const FingerGrasp twisted = {OnEdge(triangle, 0, 0, 0.6), OnEdge(triangle, 1, 1, 0.6),
                               OnEdge(triangle, 2, 2, 0.6)};
  const double critical =
      ComputeRequiredHalfAngle(ContactsOf(twisted), triangle.wrench_frame()).value().upper;
  EXPECT_GT(critical, Radians(5));
  EXPECT_TRUE(LosesObject(ReplayPlan(triangle, MakePlanarPlan(twisted, 0.9 * Degrees(critical)), {})
                              .steps.at(0)
                              .reason));
  EXPECT_EQ(
      ReplayPlan(triangle, MakePlanarPlan(twisted, 1.5 * Degrees(critical)), {}).steps.at(0).reason,
      Reason::kNone);
}

/// Three switches of the square: one finger for another, two for two, one more.
Plan SquareSwitches(const Polygon& square) {
  Plan plan = MakePlanarPlan({OnEdge(square, 0, 1, 0.45), OnEdge(square, 1, 3, 0.5)}, 20);
  plan.steps = {
      Switch{{OnEdge(square, 2, 0, 0.4), OnEdge(square, 3, 2, 0.55)}, {0, 1}},
      Switch{{OnEdge(square, 0, 0, 0.7)}, {}},
      Switch{{OnEdge(square, 1, 2, 0.2)}, {3}},
      Switch{{OnEdge(square, 3, 2, 0.8)}, {1}},
  };
  return plan;
}

TEST(PlanarSwitch, ReplaysSwitches) {
  const Polygon square = MakeSquare();
  ExpectGood(ReplayPlan(square, SquareSwitches(square), {}), 5);
}

}  // namespace
}  // namespace regrasp
