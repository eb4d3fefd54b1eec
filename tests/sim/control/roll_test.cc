#include <gtest/gtest.h>

#include "planner/plan/check.h"
#include "sim/control/slide.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace roll_test {

constexpr double kGood = 1e-4;

/// Replay a sliding step with a hand without a spare finger.
StepReplay ReplayAlone(const object::Object& object, plan::Plan plan, const plan::Align& align) {
  plan.fingers = static_cast<int>(plan.initial.size());
  plan.steps = {align};
  const ReplayResult result = ReplayPlan(object, plan, {});
  EXPECT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps.front().reason, plan::Reason::kNone) << result.steps.front().detail;
  return result.steps.back();
}

/// Expect that all fingers rolled to the last waypoint, and that the object moved only slightly.
void ExpectRolled(const object::Object& object, const StepReplay& step, const plan::Align& align) {
  EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
  EXPECT_NEAR(step.align_shares.best_effort, 1, 1e-9);
  EXPECT_LT(step.drift_m, kGood * object.diameter());
  int arrived = 0;
  for (const plan::FingerContact& held : align.waypoints.back()) {
    const plan::FingerState& state = step.snapshot.fingers.at(held.finger);
    const Eigen::Vector3d at = step.snapshot.X_WO.inverse() * state.contact_W;
    EXPECT_LT((at - held.contact.p).norm(), kGood * object.diameter());
    ++arrived;
  }
  EXPECT_EQ(arrived, static_cast<int>(align.waypoints.front().size()));
}

TEST(RollFingers, CarriesOutAnAlignOfAHandThatNeedsAllFingers) {
  const object::Polygon triangle = MakeTriangle(0.08);
  const auto at = [&](double share) {
    return plan::FingerGrasp{OnEdge(triangle, 0, 0, share), OnEdge(triangle, 1, 1, share),
                             OnEdge(triangle, 2, 2, share)};
  };
  const plan::Align align{{at(0.5), at(0.55)}};
  const StepReplay step = ReplayAlone(triangle, MakePlanarPlan(at(0.5), 15), align);
  ExpectRolled(triangle, step, align);
}

TEST(RollFingers, GoesRoundACornerOfASquareWithAllFourFingers) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Align align = AroundTheCorner(square);
  plan::Plan plan = MakePlanarPlan(align.waypoints.front(), 10);
  plan.steps = {align};
  plan.goal = plan::ContactsOf(align.waypoints.back());
  const plan::PlanCheck check = plan::CheckPlan(square, plan);
  ASSERT_TRUE(check.passed()) << check.steps.back().detail;
  ExpectRolled(square, ReplayAlone(square, plan, align), align);
}

TEST(RollFingers, FailsWhereTheFrictionIsTooSmallOnTheWay) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 0, 0.4)};
  plan::FingerGrasp end = start;
  end[0].contact = OnEdge(square, 1, 0.9);
  end[1].contact = OnEdge(square, 3, 0.9);
  // Fingers 0 and 1 end 48 mm apart along their edges, which are 60 mm long. Together with finger 2
  // this grasp requires more than 10°.
  const StepReplay step = ReplayAlone(square, MakePlanarPlan(start, 10), plan::Align{{start, end}});
  EXPECT_NE(step.reason, plan::Reason::kNone);
}

}  // namespace roll_test
}  // namespace regrasp::sim
