#include "sim/measure/disturbance.h"

#include <gtest/gtest.h>

#include <iostream>
#include <set>

#include "sim/world/motion_monitor.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace disturbance_test {

StepReplay HoldUnder(Protocol protocol, const object::Object& object, const plan::Plan& plan,
                     ReplayOptions options = {}) {
  options.protocol = protocol;
  return ReplayPlan(object, plan, options).steps.at(0);
}

TEST(PushTest, ThereAreTwelveDirectionsInSpaceAndSixInThePlane) {
  std::set<std::string> space, plane;
  for (const Disturbance& disturbance : DisturbanceDirections(3))
    space.insert(DisturbanceName(disturbance));
  for (const Disturbance& disturbance : DisturbanceDirections(2))
    plane.insert(DisturbanceName(disturbance));
  EXPECT_EQ(space.size(), 12u);
  EXPECT_EQ(plane, (std::set<std::string>{"force +x", "force -x", "force +y", "force -y",
                                          "torque +z", "torque -z"}));
  const grasp::Wrench turn = DisturbanceWrench({true, 1, -1}, 3);
  EXPECT_TRUE(turn.force.isZero(0));
  EXPECT_EQ(turn.torque_over_radius, Eigen::Vector3d(0, -3, 0));
}

TEST(ProtocolTest, AGoodGraspPassesBothAndTheAdaptedOneDecides) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  const StepReplay both = HoldUnder(Protocol::kBoth, cube.object, plan);
  ASSERT_TRUE(both.adapted && both.fixed);
  EXPECT_EQ(both.adapted->reason, plan::Reason::kNone);
  EXPECT_EQ(both.fixed->reason, plan::Reason::kNone);
  EXPECT_EQ(both.moved_m, both.adapted->moved_m);
  const StepReplay adapted = HoldUnder(Protocol::kAdapted, cube.object, plan);
  const StepReplay fixed = HoldUnder(Protocol::kFixed, cube.object, plan);
  EXPECT_FALSE(adapted.fixed);
  EXPECT_FALSE(fixed.adapted);
  // Each disturbance starts from the same saved state, so that it does not depend on the other
  // disturbances.
  EXPECT_EQ(adapted.moved_m, both.adapted->moved_m);
  EXPECT_EQ(fixed.moved_m, both.fixed->moved_m);
  EXPECT_EQ(fixed.slip_m, both.fixed->slip_m);
  // With fixed forces the servos yield, with adapted forces they need not.
  EXPECT_GT(fixed.give_m, 1e-5 * cube.object.diameter());
  EXPECT_EQ(adapted.give_m, 0);
}

TEST(ProtocolTest, BothFailBelowTheRequiredFriction) {
  const CubeCase cube;
  // The grasp requires 5.3°.
  const StepReplay hold = HoldUnder(Protocol::kBoth, cube.object, MakePlan(cube.Start(), 4.5));
  EXPECT_NE(hold.adapted->reason, plan::Reason::kNone);
  EXPECT_NE(hold.fixed->reason, plan::Reason::kNone);
  const object::Polygon square = MakeSquare(0.03);
  // The line to the other contact is 18.4° off each normal.
  const plan::Plan pair =
      MakePlanarPlan({OnEdge(square, 0, 1, 0.333), OnEdge(square, 1, 3, 0.333)}, 17);
  const StepReplay planar = HoldUnder(Protocol::kBoth, square, pair);
  EXPECT_NE(planar.adapted->reason, plan::Reason::kNone);
  EXPECT_NE(planar.fixed->reason, plan::Reason::kNone);
}

TEST(ProtocolTest, AFixedSqueezeFailsUnderAPushThatAdaptedForcesResist) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  ReplayOptions options;
  options.disturbance_ratio = 0.1;
  const StepReplay hold = HoldUnder(Protocol::kBoth, cube.object, plan, options);
  EXPECT_EQ(hold.adapted->reason, plan::Reason::kNone) << hold.adapted->detail;
  EXPECT_NE(hold.fixed->reason, plan::Reason::kNone);
  EXPECT_EQ(hold.reason, plan::Reason::kNone);
  EXPECT_NE(HoldUnder(Protocol::kFixed, cube.object, plan, options).reason, plan::Reason::kNone);
}

TEST(ProtocolTest, TheMarginsAreSmallerUnderTheShakeThanAtRestAndZeroWhereAFingerSlips) {
  const CubeCase cube;
  const StepReplay good = HoldUnder(Protocol::kBoth, cube.object, MakePlan(cube.Start(), 25));
  ASSERT_EQ(good.static_margins.size(), 4u);
  for (const auto& [finger, rest] : good.static_margins) {
    EXPECT_GT(rest, kConeReached);
    EXPECT_LT(rest, Radians(25));
    EXPECT_LE(good.adapted->disturbance_margins.at(finger), rest + 1e-6);
    EXPECT_LE(good.fixed->disturbance_margins.at(finger), rest + 1e-6);
  }
  EXPECT_GT(*SmallestMargin(good.adapted->disturbance_margins), kConeReached);
  const StepReplay bad = HoldUnder(Protocol::kBoth, cube.object, MakePlan(cube.Start(), 4.5));
  EXPECT_LT(*SmallestMargin(bad.fixed->disturbance_margins), kConeReached);
}

TEST(ProtocolTest, WhatComesAfterAFailedFixedShakeIsAsWithoutIt) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}}};
  ReplayOptions options;
  options.disturbance_ratio = 0.1;
  options.protocol = Protocol::kBoth;
  const ReplayResult both = ReplayPlan(cube.object, plan, options);
  options.protocol = Protocol::kAdapted;
  const ReplayResult adapted = ReplayPlan(cube.object, plan, options);
  ASSERT_EQ(both.steps.size(), 2u);
  ASSERT_EQ(adapted.steps.size(), 2u);
  EXPECT_NE(both.steps[0].fixed->reason, plan::Reason::kNone);
  EXPECT_EQ(both.steps[1].drift_m, adapted.steps[1].drift_m);
  EXPECT_EQ(both.steps[1].moved_m, adapted.steps[1].moved_m);
}

}  // namespace disturbance_test

namespace weakest_finger_test {

using plan::EntryIndex;

/// Compute the expected result of WeakestFingers for a step from its grasps one by one.
std::optional<NeedOfFinger> WeakestOf(const std::vector<plan::FingerGrasp>& grasps,
                                      const object::WrenchFrame& frame, double friction_angle) {
  std::vector<NeedOfFinger> needs;
  std::vector<grasp::FingerFriction> friction;
  for (const plan::FingerGrasp& grasp : grasps) {
    const auto all = grasp::MeasureFingerFriction(plan::ContactsOf(grasp), frame, friction_angle);
    for (std::size_t i = 0; i < all.size(); ++i) needs.push_back({grasp[i].finger, all[i]});
    friction.insert(friction.end(), all.begin(), all.end());
  }
  const int weakest = grasp::WeakestFinger(friction);
  return weakest < 0 ? std::nullopt : std::optional(needs[weakest]);
}

TEST(WeakestFingerTest, OfEveryEntryItIsTheWeakestOfAllItsGrasps) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  const plan::Switch change{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}};
  const plan::FingerGrasp after = plan::GraspAfter(plan.initial, change);
  plan::FingerGrasp moved = after;
  moved.back().contact.p.x() += 0.01;
  plan.steps = {change, plan::Align{{after, moved}}};
  const object::WrenchFrame frame = cube.object.wrench_frame();
  WeakestFingers fingers(plan, frame, Radians(25));
  const std::vector<std::vector<plan::FingerGrasp>> expected = {
      {plan.initial}, {plan.initial, after}, {after, moved}};
  int different = 0;
  for (int entry = 0; entry < 3; ++entry) {
    const auto found = fingers.OfEntry(EntryIndex(entry));
    const auto weakest = WeakestOf(expected[entry], frame, Radians(25));
    ASSERT_TRUE(found && weakest) << entry;
    EXPECT_EQ(found->finger, weakest->finger) << entry;
    EXPECT_EQ(found->friction.required, weakest->friction.required) << entry;
    EXPECT_EQ(found->friction.without, weakest->friction.without) << entry;
    const auto initial = fingers.OfEntry(EntryIndex(0));
    different += initial->friction.required != found->friction.required ? 1 : 0;
  }
  EXPECT_GT(different, 0);
}

TEST(WeakestFingerTest, AGraspThatIsNotForceClosureHasNone) {
  const CubeCase cube;
  const object::WrenchFrame frame = cube.object.wrench_frame();
  const plan::Plan weak = MakePlan(cube.Start(), 4);
  EXPECT_FALSE(WeakestFingers(weak, frame, Radians(4)).OfEntry(EntryIndex(0)));
  const plan::Plan empty = MakePlan({}, 4);
  EXPECT_FALSE(WeakestFingers(empty, frame, Radians(4)).OfEntry(EntryIndex(0)));
}

}  // namespace weakest_finger_test
}  // namespace regrasp::sim
