#include "sim/world/replay_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/control/slide.h"
#include "sim/measure/disturbance.h"
#include "tests/sim/held_cube.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace replay_world_test {

using testing::HasSubstr;

/// Drag a finger by a share of D.
void Drag(ReplayWorld& world, int finger, double share, const Eigen::Vector3d& direction) {
  world.fingers()[finger].anchor_S += share * world.settings().diameter_m * direction;
  ComeToRest(world);
}

TEST(MonitorOfAReplay, SeesAFingerThatIsDraggedOverTheSurface) {
  HeldCube little, far;
  Drag(little.world, 0, 5e-4, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(little.world.monitor().reason(), plan::Reason::kNone)
      << little.world.monitor().detail();
  Drag(far.world, 0, 0.02, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(far.world.monitor().reason(), plan::Reason::kSlipped);
  EXPECT_THAT(far.world.monitor().detail(), HasSubstr("finger 0"));
}

TEST(MonitorOfAReplay, SeesAFingerSlipThatHasSlidOnPurposeBefore) {
  // Two opposite fingers, and a redundant one below, which slides.
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 0, 0.4)};
  plan::FingerGrasp end = start;
  end[2] = OnEdge(square, 2, 0, 0.5);
  plan::Plan plan = MakePlanarPlan(start, 15);
  plan.steps = {plan::Align{{start, end}}};
  ReplayOptions options;
  options.align = AlignChoice::kSlide;
  const ReplayObserver observer;
  ReplayWorld world(square, plan, MakeScene(square, plan, 1, options), observer);
  TakeHold(world, ToScene(square, plan.scale, start));
  ComeToRest(world);
  ASSERT_EQ(PerformAlign(world, *world.scene().entries.at(1).script), AlignMode::kSlid);
  ComeToRest(world);
  ASSERT_EQ(world.monitor().reason(), plan::Reason::kNone) << world.monitor().detail();
  Drag(world, 2, 0.02, Eigen::Vector3d::UnitX());
  EXPECT_EQ(world.monitor().reason(), plan::Reason::kSlipped);
  EXPECT_THAT(world.monitor().detail(), HasSubstr("finger 2"));
}

TEST(MonitorOfAReplay, SeesAtRestThatAFingerIsOffTheSurface) {
  HeldCube held;
  WorldFinger& finger = held.world.fingers()[0];
  finger.force_S.setZero();
  finger.anchor_S -= 0.05 * held.world.settings().diameter_m * finger.contact.n;
  ComeToRest(held.world);
  EXPECT_EQ(held.world.monitor().reason(), plan::Reason::kContactLost);
  EXPECT_THAT(held.world.monitor().detail(), HasSubstr("finger 0"));
}

TEST(MonitorOfAReplay, SeesUnderAFixedPushThatAFingerIsOffTheSurface) {
  // The square moves away from one of two opposite fingers, whose servos yield, and back again.
  const object::Polygon square = MakeSquare(0.03);
  const plan::Plan plan =
      MakePlanarPlan({OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)}, 70);
  const ReplayObserver observer;
  for (const auto& [share, reason] :
       {std::pair{0.8, plan::Reason::kNone}, {1.2, plan::Reason::kContactLost}}) {
    ReplayWorld world(square, plan, MakeScene(square, plan, 0, {}), observer);
    TakeHold(world, ToScene(square, plan.scale, plan.initial));
    ComeToRest(world);
    DisturbOnce(world, DisturbanceWrench({false, 0, 1}, share * world.settings().grasp_force_N),
                DisturbanceResponse::kFixed);
    EXPECT_EQ(world.monitor().reason(), reason) << share << world.monitor().detail();
  }
}

TEST(MonitorOfAReplay, SeesAfterAFixedPushThatAFingerIsOffTheSurface) {
  // Only under the disturbance force does the cube touch a finger that is slightly apart.
  HeldCube held;
  ReplayWorld& world = held.world;
  const double D = world.settings().diameter_m;
  for (const auto& [f, off] : {std::pair{2, 1e-4}, {3, 0.01}}) {
    world.fingers()[f].force_S.setZero();
    world.fingers()[f].anchor_S -= off * D * world.fingers()[f].contact.n;
  }
  world.fingers()[3].holding = false;
  (void)WaitUntilStill(world);
  world.StartMonitoring();
  DisturbOnce(world, DisturbanceWrench({false, 1, 1}, 0.02 * world.settings().grasp_force_N),
              DisturbanceResponse::kFixed);
  EXPECT_EQ(world.monitor().reason(), plan::Reason::kContactLost) << world.monitor().detail();
}

TEST(MonitorOfAReplay, AnEngineThatCannotGoOnIsNoPass) {
  const CubeCase cube;
  ReplayObserver observer;
  observer.on_sample = [](const plan::Snapshot&) { throw UnstableError("made up"); };
  const ReplayResult result = ReplayPlan(cube.object, MakePlan(cube.Start(), 25), {}, observer);
  EXPECT_EQ(result.steps.at(0).reason, plan::Reason::kSimulationUnstable);
  EXPECT_EQ(result.steps.at(0).detail,
            "the simulation became unstable as the fingers took hold: made up");
}

TEST(MonitorOfAReplay, WhatDoesNotComeToRestHasMovedHoweverFarItCame) {
  ReplayOptions options;
  options.tolerance = 1;
  HeldCube held(options);
  // Without contact the cube falls continuously, by less than the tolerance.
  for (WorldFinger& finger : held.world.fingers()) {
    finger.force_S.setZero();
    finger.anchor_S -= 0.05 * held.world.settings().diameter_m * finger.contact.n;
    finger.holding = false;
  }
  ComeToRest(held.world);
  const MotionMonitor& monitor = held.world.monitor();
  EXPECT_LT(monitor.moved_m(), options.tolerance * held.world.settings().diameter_m);
  EXPECT_EQ(monitor.reason(), plan::Reason::kObjectMoved);
  EXPECT_THAT(monitor.detail(), HasSubstr("did not come to rest"));
}

/// Expect that the first step of a plan passes at a tolerance slightly above its motion and slip.
/// At a smaller tolerance it must fail for the quantity that exceeds it.
void ExpectJudgedByTheTolerance(const object::Object& object, const plan::Plan& plan,
                                AlignChoice align) {
  ReplayOptions options;
  options.align = align;
  const auto replay = [&](double tolerance_m) {
    options.tolerance = tolerance_m / object.diameter();
    return ReplayPlan(object, plan, options).steps.back();
  };
  const StepReplay step = replay(1e-3 * object.diameter());
  ASSERT_EQ(step.index, 1) << step.detail;
  ASSERT_EQ(step.reason, plan::Reason::kNone) << step.detail;
  ASSERT_GT(step.slip_m, 0);
  EXPECT_EQ(replay(1.1 * std::max(step.moved_m, step.slip_m)).reason, plan::Reason::kNone);
  EXPECT_EQ(replay(0.9 * step.slip_m).reason, plan::Reason::kSlipped);
  if (0.9 * step.moved_m > step.slip_m) {
    EXPECT_EQ(replay(0.9 * step.moved_m).reason, plan::Reason::kObjectMoved);
  }
}

TEST(MonitorOfAReplay, AnAlignInSpaceMayMoveTheObjectByTheToleranceAndNoMore) {
  const CubeCase cube;
  plan::FingerGrasp end = cube.Start();
  end[0] = cube.At(0, 0.03, 0.008, 0.006);
  plan::Plan plan = MakePlan(cube.Start(), 35);
  plan.steps = {plan::Align{{cube.Start(), end}}};
  for (const AlignChoice choice : {AlignChoice::kImitate, AlignChoice::kSlide}) {
    ExpectJudgedByTheTolerance(cube.object, plan, choice);
  }
}

TEST(MonitorOfAReplay, AnAlignInThePlaneMayMoveTheObjectByTheToleranceAndNoMore) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp start = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5),
                                   OnEdge(square, 2, 0, 0.4)};
  plan::FingerGrasp end = start;
  end[2] = OnEdge(square, 2, 0, 0.7);
  plan::Plan plan = MakePlanarPlan(start, 15);
  plan.steps = {plan::Align{{start, end}}};
  for (const AlignChoice choice : {AlignChoice::kImitate, AlignChoice::kSlide}) {
    ExpectJudgedByTheTolerance(square, plan, choice);
  }
}

}  // namespace replay_world_test
}  // namespace regrasp::sim
