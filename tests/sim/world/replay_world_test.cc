#include "sim/world/replay_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/required_friction_angle.h"
#include "sim/control/slide.h"
#include "sim/measure/disturbance.h"
#include "sim/world/motion_monitor.h"
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
  EXPECT_EQ(result.steps.at(0).detail, "the simulation diverges while the fingers grasp: made up");
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
  EXPECT_THAT(monitor.detail(), HasSubstr("does not settle"));
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

namespace stillness_test {

/// Tested time steps, as shares of the derived time step.
constexpr double kTimesteps[] = {1, 0.5, 0.125};

ReplayOptions WithTimestep(double factor) {
  ReplayOptions options;
  options.timestep_factor = factor;
  return options;
}

/// Replay two opposite fingers in the middle of the sides of the square.
/// A force of ρ F requires a friction coefficient of ρ, and a torque of ρ F R requires ρ D / side =
/// √2 ρ. With slightly less, the square rotates until it is wedged between the fingers. If the
/// disturbance is small, this rotation is below the tolerance.
plan::Reason Pinch(double friction, const ReplayOptions& options) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Plan plan = MakePlanarPlan({OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)},
                                         Degrees(std::atan(friction)));
  return ReplayPlan(square, plan, options).steps.at(0).reason;
}

TEST(Stillness, ABodyThatNothingHoldsFailsUnderEveryShakeThatIsAllowed) {
  const CubeCase cube;
  const object::Polygon square = MakeSquare(0.03);
  ReplayOptions options;
  options.gravity = false;
  int failed = 0;
  for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
    for (const double disturbance_ratio : {1.01 * LeastDisturbance(tolerance), 1e-3, 1e-2, 0.1}) {
      if (disturbance_ratio < LeastDisturbance(tolerance)) continue;
      for (const Protocol protocol : {Protocol::kAdapted, Protocol::kFixed}) {
        SCOPED_TRACE(std::to_string(tolerance) + " " + std::to_string(disturbance_ratio));
        options.tolerance = tolerance;
        options.disturbance_ratio = disturbance_ratio;
        options.protocol = protocol;
        EXPECT_EQ(ReplayPlan(cube.object, MakePlan({}, 25), options).steps.at(0).reason,
                  plan::Reason::kObjectMoved);
        EXPECT_EQ(ReplayPlan(square, MakePlanarPlan({}, 25), options).steps.at(0).reason,
                  plan::Reason::kObjectMoved);
        ++failed;
      }
    }
  }
  EXPECT_GE(failed, 20);
}

TEST(Stillness, AShakeThatABodyThatNothingHoldsWouldStandIsRefused) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  ReplayOptions options;
  for (const auto& [disturbance_ratio, tolerance] :
       {std::pair{1e-5, 1e-3}, {0.01, 9.0}, {1e-7, 1e-9}, {1e-5, 1e-9}}) {
    SCOPED_TRACE(disturbance_ratio);
    options.disturbance_ratio = disturbance_ratio;
    options.tolerance = tolerance;
    EXPECT_THROW((void)ReplayPlan(cube.object, plan, options), InputError);
  }
  options.disturbance_ratio = 2 * LeastDisturbance(1e-3);
  options.tolerance = 1e-3;
  EXPECT_EQ(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
  options.disturbance_ratio = 0;  // requires no minimum
  EXPECT_EQ(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
}

TEST(Stillness, APinchThatSlidesFailsAndOneThatHoldsPassesAtEveryTimeStep) {
  const double needed = std::sqrt(2.0) * ReplayOptions().disturbance_ratio;
  for (const double factor : kTimesteps) {
    SCOPED_TRACE(factor);
    for (const double share : {0.6, 0.78, 0.9}) {
      EXPECT_NE(Pinch(share * needed, WithTimestep(factor)), plan::Reason::kNone) << share;
    }
    EXPECT_EQ(Pinch(1.03 * needed, WithTimestep(factor)), plan::Reason::kNone);
  }
}

TEST(Stillness, ASmallShakeTellsAPinchThatSlidesFromOneThatHolds) {
  ReplayOptions options;
  options.disturbance_ratio = 1e-3;
  const double needed = std::sqrt(2.0) * options.disturbance_ratio;
  EXPECT_NE(Pinch(0.6 * needed, options), plan::Reason::kNone);
  EXPECT_EQ(Pinch(1.1 * needed, options), plan::Reason::kNone);
}

/// Return the largest disturbance that a planar grasp resists in every direction of the test, over
/// the grasp force.
double LargestShake(const object::Polygon& polygon, const grasp::Grasp& grasp,
                    double friction_angle) {
  double least = 1;
  for (const Disturbance& disturbance : DisturbanceDirections(2)) {
    const auto load = grasp::ComputeLargestLoad(grasp, polygon.wrench_frame(), friction_angle, {},
                                                DisturbanceWrench(disturbance, 1), 1);
    least = std::min(least, load ? load->lower : 0);
  }
  return least;
}

/// Draw a plan with a grasp of two or three fingers that slightly fails to resist the default
/// disturbance. It requires at most `most` times its grasp force.
plan::Plan DrawNearLimit(const object::Polygon& polygon, double most, std::mt19937& random) {
  std::uniform_real_distribution<double> degrees(5, 35);
  for (int draw = 0;; ++draw) {
    plan::FingerGrasp grasp;
    for (int f = 0; f < 2 + draw % 2; ++f) grasp.push_back(DrawOnBoundary(polygon, f, random));
    const plan::Plan plan = MakePlanarPlan(grasp, degrees(random));
    const double resisted = LargestShake(polygon, plan::ContactsOf(grasp), plan.friction_angle);
    const double needed = ReplayOptions().disturbance_ratio / resisted;
    if (needed > 1.002 && needed < most) return plan;
  }
}

TEST(Stillness, PlanarGraspsThatNeedALittleMoreSqueezeFailAndPassWithLessShake) {
  std::mt19937 random(12);
  for (const char* name : {"polygon40.wkt", "polygon_hole.wkt", "bottle200.wkt"}) {
    const object::ObjectFile file = ReadModel(name);
    const auto& polygon = dynamic_cast<const object::Polygon&>(*file.object);
    for (int k = 0; k < 10; ++k) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(k));
      const plan::Plan plan = DrawNearLimit(polygon, k < 5 ? 1.2 : 1.05, random);
      EXPECT_NE(ReplayPlan(polygon, plan, {}).steps.at(0).reason, plan::Reason::kNone);
      ReplayOptions less;
      less.disturbance_ratio =
          0.95 * LargestShake(polygon, plan::ContactsOf(plan.initial), plan.friction_angle);
      const StepReplay hold = ReplayPlan(polygon, plan, less).steps.at(0);
      EXPECT_EQ(hold.reason, plan::Reason::kNone) << hold.detail;
    }
  }
}

/// Replay a grasp at a share of its required friction, with every time step.
void ExpectFailsAtEveryTimeStep(const object::Polyhedron& body, const plan::FingerGrasp& grasp,
                                double friction) {
  const plan::Plan plan = MakePlan(grasp, Degrees(std::atan(friction)), 4);
  for (const double factor : kTimesteps) {
    EXPECT_NE(ReplayPlan(body, plan, WithTimestep(factor)).steps.at(0).reason, plan::Reason::kNone)
        << "time step " << factor;
  }
}

TEST(Stillness, GraspsThatAreNotForceClosureFailAtEveryTimeStep) {
  std::mt19937 random(7);
  for (const char* name : {"l_block.obj", "stone.obj", "body36.obj"}) {
    const object::ObjectFile file = ReadModel(name);
    const auto& body = dynamic_cast<const object::Polyhedron&>(*file.object);
    for (int examined = 0; examined < 8;) {
      plan::FingerGrasp grasp;
      for (FingerIndex f{0}; f < 4; ++f) grasp.push_back({f, DrawContact(body, random)});
      const auto required =
          grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(grasp), body.wrench_frame());
      if (!required || required->upper > Radians(50) || required->upper < Radians(2)) continue;
      SCOPED_TRACE(std::string(name) + " " + std::to_string(examined));
      const double share = examined % 2 == 0 ? 0.95 : 0.997;
      ExpectFailsAtEveryTimeStep(body, grasp, share * std::tan(required->lower));
      ++examined;
    }
  }
}

TEST(Stillness, AGoodGraspPassesAtEveryTimeStepByTheSameMotion) {
  const CubeCase cube;
  for (const double factor : kTimesteps) {
    const StepReplay hold =
        ReplayPlan(cube.object, MakePlan(cube.Start(), 25), WithTimestep(factor)).steps.at(0);
    EXPECT_EQ(hold.reason, plan::Reason::kNone) << factor << hold.detail;
  }
}

TEST(Stillness, AHeldBodyIsStillAndStaysSo) {
  HeldCube held;
  const double before = held.world.engine().time();
  EXPECT_TRUE(WaitUntilStill(held.world));
  const double waited = held.world.engine().time() - before;
  EXPECT_NEAR(waited, kStillTime * held.world.settings().characteristic_time_s, 1e-9 * before);
  ComeToRest(held.world);
  EXPECT_EQ(held.world.monitor().reason(), plan::Reason::kNone);
}

TEST(Stillness, AFingerThatMovesIsWaitedForThoughTheBodyIsStill) {
  HeldCube held;
  ReplayWorld& world = held.world;
  // Additional finger that counts as holding, far from the cube.
  const FingerIndex apart{4};
  world.fingers()[apart].holding = true;
  world.StartMonitoring();
  const auto wait = [&] {
    const double before = world.engine().time();
    EXPECT_TRUE(WaitUntilStill(world));
    return (world.engine().time() - before) / world.settings().characteristic_time_s;
  };
  EXPECT_NEAR(wait(), kStillTime, 1e-6);
  world.engine().ShiftTip(apart, 1e-3 * world.settings().diameter_m * Eigen::Vector3d::UnitX());
  EXPECT_GT(wait(), 1.1 * kStillTime);
}

TEST(Stillness, ABodyThatIsLetGoNeverComesToRest) {
  HeldCube held;
  for (WorldFinger& finger : held.world.fingers()) finger.force_S.setZero();
  EXPECT_FALSE(WaitUntilStill(held.world));
}

}  // namespace stillness_test
}  // namespace regrasp::sim
