#include <gtest/gtest.h>

#include <iostream>

#include "planner/plan/check.h"
#include "sim/control/slide.h"
#include "sim/scene/align_script.h"
#include "tests/sim/control/boundary_walk.h"

namespace regrasp::sim {
namespace planar_corner_test {

constexpr double kGood = 1e-4;

/// Return the number of moves of a script, each of two finger switches.
int CountMoves(const object::Polygon& polygon, const plan::Plan& plan) {
  const AlignLimits limits{
      plan.friction_angle, {FingerIndex(2)}, 1e-3 * polygon.diameter(), 1e-4 * polygon.diameter()};
  return static_cast<int>(
      WriteAlignScript(polygon, std::get<plan::Align>(plan.steps.front()), limits).moves.size());
}

/// Expect that the sliding step passes the check and the replay.
/// The third finger imitates it, and every finger must reach its target.
void ExpectPasses(const object::Polygon& polygon, const plan::Plan& plan, int least_turns,
                  int most_moves) {
  const plan::Align& align = std::get<plan::Align>(plan.steps.front());
  EXPECT_GE(CountTurns(align), least_turns);
  EXPECT_LE(CountMoves(polygon, plan), most_moves);
  const plan::PlanCheck check = plan::CheckPlan(polygon, plan);
  ASSERT_TRUE(check.passed()) << check.steps.back().detail;
  const ReplayResult result = ReplayPlan(polygon, check.projected, {});
  ASSERT_EQ(result.steps.size(), 2u) << result.steps.back().detail;
  const StepReplay& step = result.steps[1];
  EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
  EXPECT_EQ(step.align_mode, AlignMode::kImitated);
  EXPECT_LT(step.drift_m, kGood * polygon.diameter());
  EXPECT_GT(result.settings.fingertip_radius_m, 1e-3 * polygon.diameter());
  std::size_t arrived = 0;
  for (const plan::FingerContact& held : align.waypoints.back()) {
    const plan::FingerState& state = step.snapshot.fingers.at(held.finger);
    ASSERT_EQ(state.finger, held.finger);
    EXPECT_LT((step.snapshot.X_WO.inverse() * state.contact_W - held.contact.p).norm(),
              kGood * polygon.diameter());
    ++arrived;
  }
  EXPECT_EQ(arrived, 2u);
}

TEST(PlanarCorner, FingersWalkAroundADiscOfTwelveEdges) {
  const object::Polygon disc = MakeDisc(12, kDiscRadius);
  const double side = disc.face_measure(FaceIndex(0));
  const plan::Plan plan = MakeWalkPlan(disc, {{0, 0, 0.5, 4 * side}, {1, 6, 0.5, 4 * side}}, 25);
  ExpectPasses(disc, plan, 8, 16);
}

TEST(PlanarCorner, FingersWalkAroundADiscOfSixtyEdgesPastThirtyCorners) {
  const object::Polygon disc = MakeDisc(60, kDiscRadius);
  const double side = disc.face_measure(FaceIndex(0));
  const plan::Plan plan = MakeWalkPlan(disc, {{0, 0, 0.3, 15 * side}, {1, 30, 0.3, 15 * side}}, 20);
  ExpectPasses(disc, plan, 30, 12);
}

TEST(PlanarCorner, OneFingerGoesPastManyCornersInOneMoveWhereForceClosureAllows) {
  const object::Polygon disc = MakeDisc(180, kDiscRadius);
  const double side = disc.face_measure(FaceIndex(0));
  // 15 edges are 30 degrees of the circle: the line tilts by 15.
  const plan::Plan plan = MakeWalkPlan(disc, {{0, 0, 0.5, 15 * side}, {1, 90, 0.5, 0}}, 20);
  ExpectPasses(disc, plan, 15, 1);
}

TEST(PlanarCorner, FingersWalkBackwardsAndOppositeWays) {
  const object::Polygon disc = MakeDisc(60, kDiscRadius);
  const double side = disc.face_measure(FaceIndex(0));
  ExpectPasses(disc, MakeWalkPlan(disc, {{0, 0, 0.3, -9 * side}, {1, 30, 0.3, -9 * side}}, 20), 18,
               8);
  ExpectPasses(disc, MakeWalkPlan(disc, {{0, 0, 0.5, 2.2 * side}, {1, 30, 0.5, -2.2 * side}}, 20),
               4, 2);
}

TEST(PlanarCorner, FingersPassConcaveCornersWithoutRestingThere) {
  const object::Polygon gear = MakeGear(24, 0.03);
  const double side = gear.face_measure(FaceIndex(0));
  const plan::Plan plan = MakeWalkPlan(gear, {{0, 0, 0.5, 10 * side}, {1, 24, 0.5, 10 * side}}, 22);
  ExpectPasses(gear, plan, 20, 16);
  // Negative control: a finger cannot remain in a concave corner.
  const plan::Plan into = MakeWalkPlan(gear, {{0, 0, 0.5, 0.5 * side}, {1, 24, 0.5, 0}}, 22);
  const ReplayResult result = ReplayPlan(gear, into, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_EQ(result.steps[1].reason, plan::Reason::kUnreachable);
}

TEST(PlanarCorner, AFingerInTheHoleAndOneOutsideWalkAroundARing) {
  constexpr int kEdges = 60;
  const object::Polygon ring = MakeRing(kEdges);
  // The hole is clockwise: find its edge next to the outer edge 0.
  const Eigen::Vector3d outside = OnEdge(ring, 0, 0.5).p;
  FaceIndex inside;
  for (FaceIndex edge{kEdges}; edge < ring.face_count(); ++edge) {
    if ((OnEdge(ring, edge, 0.5).p - 0.6 * outside).norm() < 1e-9) inside = edge;
  }
  ASSERT_GE(inside, kEdges);
  const double outer = ring.face_measure(FaceIndex(0)), inner = ring.face_measure(inside);
  const plan::Plan plan =
      MakeWalkPlan(ring, {{0, 0, 0.3, 15 * outer}, {1, inside, 0.7, -15 * inner}}, 15);
  ExpectPasses(ring, plan, 30, 40);
}

TEST(PlanarCorner, ShortEdgesAndAlmostStraightCornersAreNoObstacle) {
  // The lower side is divided into edges of 0.3 % of the diameter. Their corners are straight or
  // bend by 0.01° in either direction.
  std::vector<Eigen::Vector2d> ring = {{0.1, 0.06}, {0, 0.06}, {0, 0}};
  constexpr double kStep = 3.5e-4, kBend = 6e-8;
  for (int i = 1; i <= 60; ++i) {
    ring.emplace_back(0.03 + i * kStep, i % 3 == 0 ? -kBend : 0.0);
  }
  ring.emplace_back(0.1, 0);
  const object::Polygon bar = object::Polygon::FromRings({ring}, "bar");
  ASSERT_LT(bar.face_measure(FaceIndex(10)), 0.0031 * bar.diameter());
  const plan::Plan plan = MakeWalkPlan(bar, {{0, 4, 0.4, 55 * kStep}, {1, 0, 0.6, -0.01}}, 20);
  ExpectPasses(bar, plan, 50, 4);
}

TEST(PlanarCorner, CornersOfExactlyAStraightAngleArePassed) {
  // Normals do not determine the edge of a waypoint at a vertex.
  const object::Polygon bar = object::Polygon::FromRings(
      {{{0, 0}, {0.02, 0}, {0.04, 0}, {0.05, 0}, {0.1, 0}, {0.1, 0.06}, {0.05, 0.06}, {0, 0.06}}},
      "bar");
  const plan::Plan plan = MakeWalkPlan(bar, {{0, 0, 0.5, 0.06}, {1, 6, 0.8, -0.05}}, 20);
  ExpectPasses(bar, plan, 4, 6);
}

TEST(PlanarCorner, AWalkNearTheLimitIsCutSoThatMixturesHaveSomethingToSpare) {
  const object::Polygon bar =
      object::Polygon::FromRings({{{0, 0}, {0.15, 0}, {0.15, 0.06}, {0, 0.06}}}, "bar");
  int checked = 0;
  for (const double needed : {17.0, 17.5, 18.0}) {
    const double ahead = 0.06 * std::tan(Radians(needed)) / 0.15;
    const plan::Plan plan = MakeWalkPlan(bar, {{0, 0, 0.3, 0.06}, {1, 2, 0.7 - ahead, -0.06}}, 20);
    ExpectPasses(bar, plan, 0, 60);
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

TEST(PlanarCorner, AContactVeryNearToACornerIsHeldAndShaken) {
  const object::Polygon disc = MakeDisc(60, kDiscRadius);
  int checked = 0;
  for (const double share : {1e-4, 1e-3, 0.999, 0.9999}) {
    const plan::Plan plan =
        MakePlanarPlan({OnEdge(disc, 0, 0, share), OnEdge(disc, 1, 30, share)}, 15, 3);
    ASSERT_TRUE(plan::CheckPlan(disc, plan).steps[0].force_closure);
    const ReplayResult result = ReplayPlan(disc, plan, {});
    EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone)
        << share << ": " << result.steps[0].detail;
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

TEST(PlanarCorner, AnAlignThatLeavesForceClosureOnTheWayFailsInCheckAndReplay) {
  const object::Polygon disc = MakeDisc(60, kDiscRadius);
  const double side = disc.face_measure(FaceIndex(0));
  // One finger moves 8 edges ahead and the other follows. They are opposite at both ends; in
  // between the line is 24 degrees off.
  plan::Align ahead = WalkBoundary(disc, {{0, 0, 0.5, 8 * side}, {1, 30, 0.5, 0}});
  const plan::Align after = WalkBoundary(disc, {{0, 8, 0.5, 0}, {1, 30, 0.5, 8 * side}});
  ahead.waypoints.insert(ahead.waypoints.end(), after.waypoints.begin() + 1, after.waypoints.end());
  for (const auto& [friction_angle, passes] : {std::pair{30.0, true}, {20.0, false}}) {
    SCOPED_TRACE(friction_angle);
    plan::Plan plan = MakePlanarPlan(ahead.waypoints.front(), friction_angle, 3);
    plan.steps = {ahead};
    plan.goal = plan::ContactsOf(ahead.waypoints.back());
    const plan::PlanCheck check = plan::CheckPlan(disc, plan);
    EXPECT_EQ(check.passed(), passes);
    const ReplayResult result = ReplayPlan(disc, check.projected, {});
    ASSERT_EQ(result.steps.size(), 2u);
    EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone) << result.steps[0].detail;
    EXPECT_EQ(result.steps[1].reason == plan::Reason::kNone, passes) << result.steps[1].detail;
    EXPECT_EQ(check.steps[1].reason, passes ? plan::Reason::kNone : plan::Reason::kNotForceClosure);
  }
}

TEST(PlanarCorner, AWalkBelowTheFrictionThatItNeedsFailsInTheReplay) {
  const object::Polygon gear = MakeGear(24, 0.03);
  const double side = gear.face_measure(FaceIndex(0));
  const plan::Plan plan = MakeWalkPlan(gear, {{0, 0, 0.5, 10 * side}, {1, 24, 0.5, 10 * side}}, 22);
  const plan::PlanCheck check = plan::CheckPlan(gear, plan);
  ASSERT_TRUE(check.passed());
  const double needed = check.steps[1].required->upper;
  plan::Plan weak = check.projected;
  weak.friction_angle = std::atan(0.9 * std::tan(needed));
  EXPECT_NE(ReplayPlan(gear, weak, {}).steps.back().reason, plan::Reason::kNone);
}

}  // namespace planar_corner_test
}  // namespace regrasp::sim
