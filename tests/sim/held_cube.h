#pragma once

#include "sim/control/slide.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {

/// The cube of CubeCase, grasped and static, with monitoring from then on.
struct HeldCube {
  CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  ReplayObserver observer;
  ReplayWorld world;

  explicit HeldCube(const ReplayOptions& options = {})
      : world(cube.object, plan, MakeScene(cube.object, plan, 0, options), observer) {
    TakeHold(world, ToScene(cube.object, plan.scale, plan.initial));
    (void)WaitUntilStill(world);
    world.StartMonitoring();
  }
};

}  // namespace regrasp::sim
