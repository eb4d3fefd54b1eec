#include "sim/shake.h"

#include "sim/grasp_control.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

void ShakeOnce(Stage& stage, const Wrench& push_S) {
  const HandForces from = CurrentForces(stage);
  const HandForces to = PlanHandForces(stage, stage.HoldingFingers(), push_S, stage.half_angle());
  const double radius = stage.settings().diameter_m / 2;
  stage.Run(kShakeRampSteps, [&](double share) {
    stage.engine().SetLoad(share * push_S.force, share * radius * push_S.torque_over_radius);
    MixForces(stage, from, to, share);
  });
  stage.Run(kShakeHoldSteps);
  stage.JudgeRest();
  stage.engine().SetLoad(Vector3d::Zero(), Vector3d::Zero());
  MixForces(stage, from, from, 0);
}

/// In the plane there are two forces and one torque.
bool IsAxis(int dimension, bool turn, int axis) { return dimension == 3 || turn == (axis == 2); }

}  // namespace

void Shake(Stage& stage) {
  const double size = stage.settings().shake * stage.settings().squeeze_N;
  if (size == 0) return;
  const Engine::State rest = stage.engine().Save();
  stage.SetSampling(false);
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!IsAxis(stage.scene().dimension, turn, axis)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vector3d push = sign * size * Vector3d::Unit(axis);
        stage.judge().SetPhase(std::string("shake, ") + (turn ? "torque " : "force ") +
                               (sign > 0 ? "+" : "-") + "xyz"[axis]);
        ShakeOnce(stage, turn ? Wrench{Vector3d::Zero(), push} : Wrench{push, Vector3d::Zero()});
        stage.engine().Restore(rest);
      }
    }
  }
  stage.SetSampling(true);
}

}  // namespace regrasp
