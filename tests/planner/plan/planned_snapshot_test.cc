#include <gtest/gtest.h>

#include <algorithm>

#include "planner/plan/check.h"
#include "planner/plan/projection.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace planned_snapshot_test {

/// Return CubePlan() in metres.
Plan PlanInMetres() {
  Plan plan = CubePlan();
  plan.scale = 1;
  return plan;
}

/// Return the states of a finger, in order.
std::vector<FingerState> StatesOf(const Snapshot& snapshot, int finger) {
  std::vector<FingerState> states;
  for (const FingerState& state : snapshot.fingers) {
    if (state.finger == FingerIndex(finger)) states.push_back(state);
  }
  return states;
}

TEST(PlannedSnapshot, OfAHoldHasTheFingersAtTheirContactsInMetres) {
  Plan plan = CubePlan();
  plan.scale = 0.5;
  const Snapshot snapshot = MakePlannedSnapshot(plan, 0, {}, 0.01);
  EXPECT_EQ(snapshot.fingertip_radius_m, 0.01);
  ASSERT_EQ(snapshot.fingers.size(), plan.initial.size());
  for (std::size_t i = 0; i < plan.initial.size(); ++i) {
    const FingerState& state = snapshot.fingers[i];
    const grasp::Contact& contact = plan.initial[i].contact;
    EXPECT_EQ(state.role, FingerRole::kHolding);
    EXPECT_EQ(state.contact_W, 0.5 * contact.p);
    EXPECT_EQ(state.normal_W, contact.n);
    EXPECT_LT((state.tip_W - (0.5 * contact.p - 0.01 * contact.n)).norm(), 1e-15);
    EXPECT_EQ(state.force_W.norm(), 0);
  }
}

TEST(PlannedSnapshot, OfASwitchTellsWhoIsPlacedAndWhoLeaves) {
  const Plan plan = PlanInMetres();
  const Snapshot snapshot = MakePlannedSnapshot(plan, 2, {}, 0);
  const auto& step = std::get<Switch>(plan.steps[1]);
  const auto placed = StatesOf(snapshot, step.place[0].finger);
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].role, FingerRole::kPlaced);
  EXPECT_EQ(StatesOf(snapshot, step.release[0]).at(0).role, FingerRole::kReleased);
  EXPECT_EQ(StatesOf(snapshot, 4).at(0).role, FingerRole::kHolding) << "placed in step 1";
}

TEST(PlannedSnapshot, OfAnAlignStopsAtTheFault) {
  const Plan plan = PlanInMetres();
  const auto& waypoints = std::get<Align>(plan.steps[2]).waypoints;
  const FingerIndex finger = waypoints[0][2].finger;
  const auto at = [&](int waypoint) {
    Fault fault;
    fault.waypoint = waypoint;
    return StatesOf(MakePlannedSnapshot(plan, 3, fault, 0), finger).at(0);
  };
  EXPECT_EQ(at(0).role, FingerRole::kHolding);
  EXPECT_EQ(at(1).role, FingerRole::kMoved);
  EXPECT_EQ(at(1).contact_W, FindFinger(waypoints[1], finger)->contact.p);
  EXPECT_EQ(at(1).path_W.front(), waypoints[0][2].contact.p);
  EXPECT_EQ(at(-1).contact_W, FindFinger(waypoints.back(), finger)->contact.p) << "at its end";
  EXPECT_EQ(at(99).contact_W, at(-1).contact_W);
}

TEST(PlannedSnapshot, ShowsTheGraspOfTheFaultWhereThatIsBetweenWaypoints) {
  const Plan plan = PlanInMetres();
  Fault fault;
  fault.grasp = std::get<Align>(plan.steps[2]).waypoints[0];
  fault.grasp[0].contact.p.y() += 0.05;
  fault.waypoint = 0;
  const Snapshot snapshot = MakePlannedSnapshot(plan, 3, fault, 0);
  EXPECT_EQ(StatesOf(snapshot, fault.grasp[0].finger).at(0).contact_W, fault.grasp[0].contact.p);
}

TEST(PlannedSnapshot, OfManyFingersShowsThoseAtFaultFirst) {
  Plan plan = CubePlan();
  for (int finger = 5; finger < 1000; ++finger) {
    plan.initial.push_back({FingerIndex(finger), plan.initial[0].contact});
  }
  Fault fault;
  fault.fingers = {FingerIndex(700)};
  const Snapshot snapshot = MakePlannedSnapshot(plan, 0, fault, 0);
  EXPECT_EQ(std::ssize(snapshot.fingers), kMostDrawnFingers);
  EXPECT_EQ(snapshot.fingers[0].finger, FingerIndex(700));
}

TEST(PlannedSnapshot, OfAnAlignWithoutWaypointsShowsTheGraspBefore) {
  Plan plan = CubePlan();
  std::get<Align>(plan.steps[2]).waypoints.clear();
  EXPECT_EQ(MakePlannedSnapshot(plan, 3, {}, 0).fingers.size(), 4u);
}

}  // namespace planned_snapshot_test
}  // namespace regrasp::plan
