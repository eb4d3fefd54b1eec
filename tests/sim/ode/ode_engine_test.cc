#include "sim/ode/ode_engine.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <limits>
#include <thread>

#include "sim/control/slide.h"
#include "sim/ode/ode_world.h"
#include "sim/scene/scaling.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"
#include "tests/sim/held_cube.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace ode_engine_test {

using Eigen::Vector3d;

ReplayOptions ByOde() {
  ReplayOptions options;
  options.engine = EngineChoice::kOde;
  return options;
}

/// Scene of the cube before any finger holds it.
struct FreeCube {
  CubeCase cube;
  Scene scene = MakeScene(cube.object, MakePlan(cube.Start(), 25), 0, ByOde());
  OdeEngine engine{scene, cube.object};
};

TEST(OdeEngineTest, WhatNothingHoldsFalls) {
  FreeCube free;
  free.engine.SetGravity(kGravity);
  constexpr int kSteps = 100;
  for (int i = 0; i < kSteps; ++i) free.engine.Step();
  const double time = kSteps * free.scene.settings.timestep_s;
  EXPECT_NEAR(free.engine.time(), time, 1e-12);
  // The numerical integration is one step ahead of the parabola.
  const double fallen = kGravity * time * time / 2 * (1 + 1.0 / kSteps);
  EXPECT_NEAR(free.engine.object_pose().translation().z(), -fallen, 1e-9 * fallen);
}

TEST(OdeEngineTest, ALoadMovesTheObjectByItsTrueMassAndInertia) {
  FreeCube free;
  const double mass = free.scene.settings.mass_kg;
  const double inertia = free.scene.inertia(2, 2);
  constexpr double kForce = 3, kTorque = 0.02;
  free.engine.SetLoad({kForce, 0, 0}, {0, 0, kTorque});
  free.engine.Step();
  const double step = free.scene.settings.timestep_s;
  const Eigen::Isometry3d pose = free.engine.object_pose();
  EXPECT_NEAR(pose.translation().x(), kForce / mass * step * step, 1e-9 * step);
  const double turn = Eigen::AngleAxisd(pose.linear()).angle();
  EXPECT_NEAR(turn, kTorque / inertia * step * step, 1e-6 * turn);
}

TEST(OdeEngineTest, ServosPullFingersThatTouchNothing) {
  FreeCube free;
  const FingerIndex spare(4);
  const Vector3d target = free.engine.tip(spare) + Vector3d(0.01, -0.02, 0.03);
  free.engine.SetTarget(spare, target);
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) free.engine.Step();
  EXPECT_LT((free.engine.tip(spare) - target).norm(), 1e-6);
  EXPECT_TRUE(free.engine.tip_force(spare).force.isZero());
}

TEST(OdeEngineTest, HoldsWithinTheConeAndBalancesTheWeight) {
  HeldCube held(ByOde());
  const ReplayWorld& world = held.world;
  Vector3d total = Vector3d::Zero();
  for (const FingerIndex f : world.HoldingFingers()) {
    const Vector3d force = world.engine().tip_force(f).force;
    const Vector3d normal = world.X_SB().linear() * world.fingers()[f].contact.n;
    EXPECT_GT(force.dot(normal), 0);
    EXPECT_GE(ConeMargin(force, normal, world.friction_angle()), 0);
    total += force;
  }
  EXPECT_LT((total + world.weight_S()).norm(), 1e-3 * world.weight_S().norm());
}

TEST(OdeEngineTest, StepsFromASavedStateRepeatTheSameBits) {
  HeldCube held(ByOde());
  Engine& engine = held.world.engine();
  const Engine::State state = engine.Save();
  const auto run = [&] {
    engine.SetLoad({1, 2, 3}, {0.1, 0, 0});
    for (int i = 0; i < 50; ++i) engine.Step();
    engine.SetLoad(Vector3d::Zero(), Vector3d::Zero());
    return engine.Save();
  };
  const Engine::State first = run();
  engine.Restore(state);
  const Engine::State second = run();
  EXPECT_EQ(first.qpos, second.qpos);
  EXPECT_EQ(first.qvel, second.qvel);
  EXPECT_EQ(first.qacc_warmstart, second.qacc_warmstart);
  EXPECT_NE(first.qpos, state.qpos);
}

TEST(OdeEngineTest, AStateThatIsNotFiniteIsUnstableAndTheSavedOneComesBack) {
  FreeCube free;
  const Engine::State state = free.engine.Save();
  free.engine.SetLoad({std::numeric_limits<double>::quiet_NaN(), 0, 0}, Vector3d::Zero());
  EXPECT_THROW(free.engine.Step(), UnstableError);
  free.engine.SetLoad(Vector3d::Zero(), Vector3d::Zero());
  free.engine.Restore(state);
  free.engine.Step();
  EXPECT_TRUE(free.engine.object_pose().translation().allFinite());
}

TEST(OdeWorldTest, AnErrorOfOdeBecomesAnException) {
  const OdeWorld world = MakeOdeWorld();
  EXPECT_THROW(dError(1, "made up %d", 5), UnstableError);
  EXPECT_THROW(dDebug(1, "made up"), UnstableError);
}

TEST(OdeEngineTest, WorldsOfTwoThreadsDoNotMeet) {
  const auto run = [] {
    HeldCube held(ByOde());
    return held.world.engine().Save().qpos;
  };
  const std::vector<double> alone = run();
  std::vector<double> first, second;
  std::thread other([&] { first = run(); });
  second = run();
  other.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

}  // namespace ode_engine_test
}  // namespace regrasp::sim
