#include <gtest/gtest.h>

#include "sim/control/slide.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace planar_align_test {

constexpr double kGood = 1e-4;

/// Expect that every finger of `target` is present in the snapshot and moved.
void ExpectArrived(const object::Object& object, const plan::Snapshot& shown,
                   const plan::FingerGrasp& target, double tolerance) {
  std::size_t arrived = 0;
  for (const plan::FingerContact& held : target) {
    for (const plan::FingerState& state : shown.fingers) {
      if (state.finger != held.finger) continue;
      EXPECT_LT((shown.X_WO.inverse() * state.contact_W - held.contact.p).norm(),
                tolerance * object.diameter());
      EXPECT_GT(state.force_W.dot(held.contact.n), 0);
      ++arrived;
    }
  }
  EXPECT_EQ(arrived, target.size());
}

/// Expect that a plan of the initial grasp and one sliding step is executed in the given mode.
void ExpectAligned(const object::Polygon& polygon, const plan::Plan& plan, AlignMode mode) {
  const ReplayResult result = ReplayPlan(polygon, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  for (const StepReplay& step : result.steps)
    EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
  EXPECT_EQ(result.steps[1].align_mode, mode);
  const double tolerance = mode == AlignMode::kImitated ? kGood : 1e-3;
  EXPECT_LT(result.steps[1].drift_m, tolerance * polygon.diameter());
  ExpectArrived(polygon, result.steps[1].snapshot,
                std::get<plan::Align>(plan.steps[0]).waypoints.back(), tolerance);
}

plan::FingerGrasp TriangleGrasp(const object::Polygon& triangle, double share) {
  return {OnEdge(triangle, 0, 0, share), OnEdge(triangle, 1, 1, share),
          OnEdge(triangle, 2, 2, share)};
}

TEST(PlanarAlign, IsImitatedFingerAfterFingerInAThreeFingerGrasp) {
  const object::Polygon triangle = MakeTriangle(0.08);
  const plan::FingerGrasp from = TriangleGrasp(triangle, 0.45), to = TriangleGrasp(triangle, 0.55);
  plan::Plan plan = MakePlanarPlan(from, 12);
  plan.steps = {plan::Align{{from, to}}};
  ExpectAligned(triangle, plan, AlignMode::kImitated);
}

TEST(PlanarAlign, IsSlidWhereNoFingerIsSpare) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp from = {OnEdge(square, 0, 1, 0.45), OnEdge(square, 1, 3, 0.5),
                                  OnEdge(square, 2, 0, 0.4), OnEdge(square, 3, 2, 0.55)};
  const plan::FingerGrasp to = {OnEdge(square, 0, 1, 0.6), OnEdge(square, 1, 3, 0.35),
                                OnEdge(square, 2, 0, 0.5), OnEdge(square, 3, 2, 0.5)};
  plan::Plan plan = MakePlanarPlan(from, 25, 4);
  plan.steps = {plan::Align{{from, to}}};
  ExpectAligned(square, plan, AlignMode::kSlid);
}

TEST(PlanarAlign, TwoFingersAreHandedOverTogetherAtLittleFriction) {
  // At 1 degree a finger can be 1 mm off the other's normal, and the fingers move by 48 mm.
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp from = {OnEdge(square, 0, 1, 0.1), OnEdge(square, 1, 3, 0.9)};
  const plan::FingerGrasp to = {OnEdge(square, 0, 1, 0.9), OnEdge(square, 1, 3, 0.1)};
  plan::Plan plan = MakePlanarPlan(from, 1, 4);
  plan.steps = {plan::Align{{from, to}}};
  ExpectAligned(square, plan, AlignMode::kImitated);
  // With a single spare finger the path needs many small pieces.
  plan.fingers = 3;
  ExpectAligned(square, plan, AlignMode::kImitated);
}

TEST(PlanarAlign, TurnsAFingerOverACornerWithAndWithoutASpareFinger) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.8), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 1, 0.4)};
  plan::FingerGrasp corner = start, turned = start, end = start;
  corner[0] = OnEdge(square, 0, 1, 1);
  turned[0] = OnEdge(square, 0, 2, 0);
  end[0] = OnEdge(square, 0, 2, 0.1);
  ASSERT_LT((corner[0].contact.p - turned[0].contact.p).norm(), 1e-15);
  for (const auto& [fingers, mode] : {std::pair{4, AlignMode::kImitated}, {3, AlignMode::kSlid}}) {
    SCOPED_TRACE(fingers);
    plan::Plan plan = MakePlanarPlan(start, 25, fingers);
    plan.steps = {plan::Align{{start, corner, turned, end}}};
    ExpectAligned(square, plan, mode);
  }
}

TEST(PlanarAlign, TurnsAFingerInAnInnerCorner) {
  const object::Polygon l = MakeL();
  // Edge 2 ends in the concave corner, at which edge 3 begins.
  plan::FingerGrasp start = {OnEdge(l, 0, 2, 0.8), OnEdge(l, 1, 0, 0.5), OnEdge(l, 2, 5, 0.5)};
  plan::FingerGrasp corner = start, turned = start, end = start;
  corner[0] = OnEdge(l, 0, 2, 1);
  turned[0] = OnEdge(l, 0, 3, 0);
  end[0] = OnEdge(l, 0, 3, 0.2);
  plan::Plan plan = MakePlanarPlan(start, 35, 4);
  plan.steps = {plan::Align{{start, corner, turned, end}}};
  ExpectAligned(l, plan, AlignMode::kImitated);
}

TEST(PlanarAlign, FailsWhereItEndsInAGraspThatDoesNotHold) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp from = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)};
  const plan::FingerGrasp to = {OnEdge(square, 0, 1, 0.8), OnEdge(square, 1, 3, 0.8)};
  plan::Plan plan = MakePlanarPlan(from, 15);
  plan.steps = {plan::Align{{from, to}}};
  const ReplayResult result = ReplayPlan(square, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_NE(result.steps[1].reason, plan::Reason::kNone);
}

}  // namespace planar_align_test
}  // namespace regrasp::sim
