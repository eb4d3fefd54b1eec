#pragma once

#include "replay_cases.h"
#include "sim/motions.h"
#include "sim/stage.h"
#include "sim/stillness.h"

namespace regrasp {

/// The cube of CubeCase, held, at rest, and judged from there.
struct HeldCube {
  CubeCase cube;
  Plan plan = MakePlan(cube.Start(), 25);
  ReplayObserver observer;
  Stage stage;

  explicit HeldCube(const ReplayOptions& options = {})
      : stage(cube.object, plan, MakeScene(cube.object, plan, 0, options), observer) {
    TakeHold(stage, ToScene(cube.object, plan.scale, plan.initial));
    (void)WaitUntilStill(stage);
    stage.StartJudging();
  }
};

}  // namespace regrasp
