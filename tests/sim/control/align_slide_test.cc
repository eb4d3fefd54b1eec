#include <gtest/gtest.h>

#include "sim/control/slide.h"
#include "sim/scene/align_script.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace align_slide_test {

constexpr double kGood = 1e-4;

ReplayOptions Sliding() {
  ReplayOptions options;
  options.align = AlignChoice::kSlide;
  return options;
}

void ExpectShares(const AlignShares& shares, double imitated, double slid) {
  EXPECT_NEAR(shares.imitated, imitated, 1e-9);
  EXPECT_NEAR(shares.slid, slid, 1e-9);
  EXPECT_NEAR(shares.best_effort, 1 - imitated - slid, 1e-9);
}

/// Two opposite fingers and one below, which is redundant.
struct SquareCase {
  object::Polygon square = MakeSquare(0.03);
  plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                             OnEdge(square, 2, 0, 0.4)};

  [[nodiscard]] plan::FingerGrasp Moved(int k, double share) const {
    plan::FingerGrasp grasp = start;
    grasp[k].contact = OnEdge(square, grasp[k].contact.face, share);
    return grasp;
  }
  [[nodiscard]] StepReplay Replay(const plan::Align& align, const ReplayOptions& options) const {
    plan::Plan plan = MakePlanarPlan(start, 15);
    plan.steps = {align};
    const ReplayResult result = ReplayPlan(square, plan, options);
    EXPECT_EQ(result.steps.size(), 2u);
    return result.steps.back();
  }
};

TEST(AlignSlide, MovesAFingerThatTheOthersDoNotNeed) {
  const SquareCase square;
  const plan::Align align{{square.start, square.Moved(2, 0.7)}};
  const StepReplay slid = square.Replay(align, Sliding());
  EXPECT_EQ(slid.reason, plan::Reason::kNone) << slid.detail;
  EXPECT_EQ(slid.align_mode, AlignMode::kSlid);
  ExpectShares(slid.align_shares, 0, 1);
  EXPECT_LT(slid.drift_m, kGood * square.square.diameter());
  int arrived = 0;
  for (const plan::FingerState& state : slid.snapshot.fingers) {
    if (state.finger != 2) continue;
    const Eigen::Vector3d at = slid.snapshot.X_WO.inverse() * state.contact_W;
    EXPECT_LT((at - OnEdge(square.square, 0, 0.7).p).norm(), 1e-3 * square.square.diameter());
    ++arrived;
  }
  EXPECT_EQ(arrived, 1);
  const StepReplay imitated = square.Replay(align, {});
  EXPECT_EQ(imitated.reason, plan::Reason::kNone) << imitated.detail;
  EXPECT_EQ(imitated.align_mode, AlignMode::kImitated);
  ExpectShares(imitated.align_shares, 1, 0);
}

TEST(AlignSlide, LeavesTheOthersToTheSpareFingerAndSaysHowMuchOfTheWay) {
  const SquareCase square;
  // One third of the travel is that of finger 2. The rest is that of finger 0, without which two
  // fingers at a right angle remain.
  plan::FingerGrasp end = square.Moved(2, 0.5);
  end[0].contact = OnEdge(square.square, 1, 0.7);
  const StepReplay step =
      square.Replay(plan::Align{{square.start, square.Moved(2, 0.5), end}}, Sliding());
  EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
  EXPECT_EQ(step.align_mode, AlignMode::kMixed);
  ExpectShares(step.align_shares, 2.0 / 3, 1.0 / 3);
}

TEST(AlignSlide, IsImitationWhereEveryFingerIsNeeded) {
  const object::Polygon triangle = MakeTriangle(0.08);
  const plan::FingerGrasp start = {OnEdge(triangle, 0, 0, 0.5), OnEdge(triangle, 1, 1, 0.5),
                                   OnEdge(triangle, 2, 2, 0.5)};
  const plan::FingerGrasp end = {OnEdge(triangle, 0, 0, 0.55), OnEdge(triangle, 1, 1, 0.55),
                                 OnEdge(triangle, 2, 2, 0.55)};
  plan::Plan plan = MakePlanarPlan(start, 15);
  plan.steps = {plan::Align{{start, end}}};
  const ReplayResult result = ReplayPlan(triangle, plan, Sliding());
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[1].reason, plan::Reason::kNone) << result.steps[1].detail;
  EXPECT_EQ(result.steps[1].align_mode, AlignMode::kImitated);
  ExpectShares(result.steps[1].align_shares, 1, 0);
  // Without a spare finger all fingers must roll together, because no other option is valid.
  plan.fingers = 3;
  const ReplayResult alone = ReplayPlan(triangle, plan, Sliding());
  ASSERT_EQ(alone.steps.size(), 2u);
  EXPECT_EQ(alone.steps[1].reason, plan::Reason::kNone) << alone.steps[1].detail;
  EXPECT_EQ(alone.steps[1].align_mode, AlignMode::kSlid);
  ExpectShares(alone.steps[1].align_shares, 0, 0);
}

TEST(AlignSlide, MovesFingersInSpaceOneAfterTheOther) {
  const CubeCase cube;
  plan::FingerGrasp end = cube.Start();
  end[0] = cube.At(0, 0.03, 0.008, 0.006);
  end[3] = cube.At(3, -0.006, -0.03, 0.004);
  plan::Plan plan = MakePlan(cube.Start(), 35);
  plan.steps = {plan::Align{{cube.Start(), end}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, Sliding());
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[1].reason, plan::Reason::kNone) << result.steps[1].detail;
  EXPECT_EQ(result.steps[1].align_mode, AlignMode::kSlid);
  ExpectShares(result.steps[1].align_shares, 0, 1);
  EXPECT_LT(result.steps[1].drift_m, kGood * cube.object.diameter());
}

TEST(AlignSlide, FailsBelowTheFrictionThatTheEndNeeds) {
  const SquareCase square;
  plan::FingerGrasp end = square.start;
  end[0].contact = OnEdge(square.square, 1, 0.9);
  end[1].contact = OnEdge(square.square, 3, 0.9);
  // Fingers 0 and 1 end 48 mm apart along their edges, which are 60 mm long. Together with finger 2
  // this grasp requires more than 10°.
  plan::Plan plan = MakePlanarPlan(square.start, 10);
  plan.steps = {plan::Align{{square.start, end}}};
  const ReplayResult result = ReplayPlan(square.square, plan, Sliding());
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_NE(result.steps[1].reason, plan::Reason::kNone);
}

TEST(AlignPathTest, AddsUpTheWaysOfAllContacts) {
  const SquareCase square;
  plan::FingerGrasp end = square.Moved(2, 0.5);
  end[0].contact = OnEdge(square.square, 1, 0.7);
  const AlignPath path(plan::Align{{square.start, square.Moved(2, 0.5), end}});
  EXPECT_NEAR(path.Travel(0, 1), 0.1 * 0.06, 1e-12);
  EXPECT_NEAR(path.Travel(0.5, 1.5), 0.05 * 0.06 + 0.1 * 0.06, 1e-12);
  EXPECT_NEAR(path.Travel(0, 2), 0.3 * 0.06, 1e-12);
}

}  // namespace align_slide_test
}  // namespace regrasp::sim
