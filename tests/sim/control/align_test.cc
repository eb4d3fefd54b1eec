#include <gtest/gtest.h>

#include "sim/control/slide.h"
#include "sim/scene/align_script.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace align_test {

constexpr double kGood = 1e-4;

plan::FingerGrasp Moved(const CubeCase& cube) {
  return {cube.At(0, 0.03, 0.010, 0.006), cube.At(1, -0.03, -0.002, 0.008),
          cube.At(2, -0.007, 0.03, -0.004), cube.At(3, -0.008, -0.03, 0.005)};
}

TEST(ReplayAlign, IsImitatedWithASpareFingerAndEveryFingerEndsAtItsTarget) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25, 5);
  plan.steps = {plan::Align{{cube.Start(), Moved(cube)}}, plan::Align{{Moved(cube), cube.Start()}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  ASSERT_EQ(result.steps.size(), 3u);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
    EXPECT_LT(step.drift_m, kGood * cube.object.diameter());
  }
  EXPECT_EQ(result.steps[0].align_mode, AlignMode::kNone);
  EXPECT_EQ(result.steps[1].align_mode, AlignMode::kImitated);
  const plan::Snapshot& shown = result.steps[1].snapshot;
  int arrived = 0;
  for (const plan::FingerContact& target : Moved(cube)) {
    for (const plan::FingerState& state : shown.fingers) {
      if (state.finger != target.finger) continue;
      EXPECT_EQ(state.role, plan::FingerRole::kMoved);
      EXPECT_LT((shown.X_WO.inverse() * state.contact_W - target.contact.p).norm(),
                kGood * cube.object.diameter());
      ASSERT_EQ(state.path_W.size(), 2u);
      EXPECT_GT((state.path_W.front() - state.contact_W).norm(), 1e-3);
      EXPECT_LT((state.path_W.back() - state.contact_W).norm(), kGood * cube.object.diameter());
      ++arrived;
    }
  }
  EXPECT_EQ(arrived, 4);
}

TEST(ReplayAlign, IsSlidWhereNoFingerIsSpare) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25, 4);
  plan.steps = {plan::Align{{cube.Start(), Moved(cube)}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[1].reason, plan::Reason::kNone) << result.steps[1].detail;
  EXPECT_EQ(result.steps[1].align_mode, AlignMode::kSlid);
  int arrived = 0;
  for (const plan::FingerState& state : result.steps[1].snapshot.fingers) {
    const Eigen::Vector3d at = result.steps[1].snapshot.X_WO.inverse() * state.contact_W;
    EXPECT_LT((at - Moved(cube)[state.finger].contact.p).norm(), 1e-3 * cube.object.diameter());
    ++arrived;
  }
  EXPECT_EQ(arrived, 4);
}

TEST(ReplayAlign, FailsWhereItEndsInAGraspThatDoesNotHold) {
  const CubeCase cube;
  plan::FingerGrasp target = cube.Start();
  // Opposite fingers move to opposite corners: the line between them is far outside cones of 10
  // degrees.
  target[0] = cube.At(0, 0.03, 0.029, 0.029);
  target[1] = cube.At(1, -0.03, -0.029, -0.029);
  target[2] = cube.At(2, 0.029, 0.03, -0.029);
  target[3] = cube.At(3, -0.029, -0.03, 0.029);
  plan::Plan plan = MakePlan(cube.Start(), 10, 5);
  plan.steps = {plan::Align{{cube.Start(), target}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_NE(result.steps[1].reason, plan::Reason::kNone);
}

TEST(ReplayAlign, TurnsAFingerOverAnEdgeWithAndWithoutASpareFinger) {
  const CubeCase cube;
  plan::FingerGrasp start = cube.Start();
  start.push_back(cube.At(4, 0.03, -0.010, -0.003));
  plan::FingerGrasp edge = start, turned = start, end = start;
  const Eigen::Vector3d corner(0.03, 0.03, 0.002);
  edge[0].contact = ContactAt(cube.object, corner, {-1, 0, 0});
  turned[0].contact = ContactAt(cube.object, corner, {0, -1, 0});
  end[0] = cube.At(0, 0.015, 0.03, 0.002);
  ASSERT_GE(turned[0].contact.face, 0);
  for (const auto& [fingers, mode] : {std::pair{6, AlignMode::kImitated}, {5, AlignMode::kSlid}}) {
    SCOPED_TRACE(fingers);
    plan::Plan plan = MakePlan(start, 25, fingers);
    plan.steps = {plan::Align{{start, edge, turned, end}}};
    const ReplayResult result = ReplayPlan(cube.object, plan, {});
    ASSERT_EQ(result.steps.size(), 2u);
    EXPECT_EQ(result.steps[1].reason, plan::Reason::kNone) << result.steps[1].detail;
    EXPECT_EQ(result.steps[1].align_mode, mode);
  }
}

TEST(InterpolateContacts, TurnsNormalsOnTheGreatCircle) {
  const CubeCase cube;
  const Eigen::Vector3d corner(0.03, 0.03, 0);
  const plan::FingerGrasp from = {{FingerIndex(0), ContactAt(cube.object, corner, {-1, 0, 0})}};
  const plan::FingerGrasp to = {{FingerIndex(0), ContactAt(cube.object, corner, {0, -1, 0})}};
  const grasp::Contact middle = Interpolate(from, to, 0.5)[0].contact;
  EXPECT_LT((middle.n - Eigen::Vector3d(-1, -1, 0).normalized()).norm(), 1e-12);
  EXPECT_EQ(middle.p, corner);
  EXPECT_EQ(Interpolate(from, to, 1)[0].contact.n, to[0].contact.n);
}

template <class Move>
int CountMoves(const CubeCase& cube, const plan::FingerGrasp& from, const plan::FingerGrasp& to,
               double degrees, std::vector<FingerIndex> spare) {
  const AlignLimits limits{Radians(degrees), std::move(spare), 1e-3, 1e-3};
  const AlignScript script = WriteAlignScript(cube.object, plan::Align{{from, to}}, limits);
  int moves = 0;
  for (const AlignMove& move : script.moves) {
    moves += std::holds_alternative<Move>(move) ? 1 : 0;
  }
  return moves;
}

TEST(AlignScriptTest, CutsUntilTheMixturesAreForceClosureAndSlidesOrRollsWhereNoneIs) {
  const CubeCase cube;
  // Two opposite pairs slide from one end of their faces to the other. Halfway through the move of
  // a pair its fingers are far from opposite, so with little friction the path must be subdivided.
  const plan::FingerGrasp from = {cube.At(0, 0.03, -0.02, -0.02), cube.At(1, -0.03, -0.02, -0.02),
                                  cube.At(2, -0.02, 0.03, -0.018),
                                  cube.At(3, -0.02, -0.03, -0.018)};
  plan::FingerGrasp to = {cube.At(0, 0.03, 0.02, 0.02), cube.At(1, -0.03, 0.02, 0.02),
                          cube.At(2, 0.02, 0.03, 0.018), cube.At(3, 0.02, -0.03, 0.018)};
  const int rough = CountMoves<FingerHandover>(cube, from, to, 20, {FingerIndex(4)});
  EXPECT_GT(rough, 0);
  EXPECT_LT(rough, CountMoves<FingerHandover>(cube, from, to, 5, {FingerIndex(4)}));
  EXPECT_EQ(CountMoves<FingersSlide>(cube, from, to, 5, {FingerIndex(4)}), 0);
  EXPECT_EQ(CountMoves<FingerHandover>(cube, from, to, 5, {}), 0);
  EXPECT_EQ(CountMoves<FingersRoll>(cube, from, to, 5, {}), 1);
  // Both pairs end skew: from a point on the path, the grasp is no longer force closure.
  to = {cube.At(0, 0.03, 0.029, 0.029), cube.At(1, -0.03, -0.029, -0.029),
        cube.At(2, 0.029, 0.03, -0.029), cube.At(3, -0.029, -0.03, 0.029)};
  EXPECT_EQ(CountMoves<FingersSlide>(cube, from, to, 5, {FingerIndex(4)}), 1);
}

}  // namespace align_test
}  // namespace regrasp::sim
