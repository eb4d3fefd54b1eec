#include "sim/shake.h"

#include "sim/grasp_control.h"
#include "sim/push.h"

namespace regrasp {

using Eigen::Vector3d;

KeepRest::KeepRest(Stage& stage)
    : stage_(stage), rest_(stage.engine().Save()), forces_(CurrentForces(stage)) {
  stage.SetSampling(false);
}

KeepRest::~KeepRest() {
  Restore();
  stage_.SetSampling(true);
}

void KeepRest::Restore() {
  stage_.engine().SetLoad(Vector3d::Zero(), Vector3d::Zero());
  MixForces(stage_, forces_, forces_, 0);
  stage_.engine().Restore(rest_);
}

namespace {

/// The push, or a share of it, as the object's load.
void Load(Stage& stage, const Wrench& push_S, double share) {
  const double radius = stage.settings().diameter_m / 2;
  stage.engine().SetLoad(share * push_S.force, share * radius * push_S.torque_over_radius);
}

void PushAdapted(Stage& stage, const Wrench& push_S) {
  const HandForces from = CurrentForces(stage);
  const HandForces to = PlanHandForces(stage, stage.HoldingFingers(), push_S, stage.half_angle());
  stage.Run(kShakeRampSteps, [&](double share) {
    Load(stage, push_S, share);
    MixForces(stage, from, to, share);
  });
  stage.Run(kShakeHoldSteps);
  stage.JudgeRest();
}

/// Runs until the object is back where it was and has stopped swinging, or is lost.
void WaitForReturn(Stage& stage) {
  const ReplaySettings& s = stage.settings();
  const double back = kReturned * s.tolerance * s.diameter_m;
  int quiet = 0;
  for (int i = 0; i < kMostReturnSteps && quiet < kFixedHoldSteps; ++i) {
    if (stage.judge().reason() != Reason::kNone) return;
    stage.Step();
    quiet = stage.judge().moved_now_m() <= back ? quiet + 1 : 0;
  }
}

void PushFixed(Stage& stage, const Wrench& push_S) {
  stage.judge().SetGiving(true);
  stage.Run(kShakeRampSteps, [&](double share) { Load(stage, push_S, share); });
  stage.Run(kFixedHoldSteps);
  stage.JudgeRest();
  stage.Run(kShakeRampSteps, [&](double share) { Load(stage, push_S, 1 - share); });
  WaitForReturn(stage);
  stage.judge().SetGiving(false);
  stage.Step();
  stage.JudgeRest();
}

}  // namespace

void PushOnce(Stage& stage, const Wrench& push_S, Answer answer) {
  answer == Answer::kAdapted ? PushAdapted(stage, push_S) : PushFixed(stage, push_S);
}

void Shake(Stage& stage, Answer answer) {
  const double size = stage.settings().shake * stage.settings().squeeze_N;
  if (size == 0) return;
  const char* name = answer == Answer::kAdapted ? "shake, " : "shake at fixed squeeze, ";
  KeepRest rest(stage);
  for (const Push& push : PushDirections(stage.scene().dimension)) {
    stage.judge().SetPhase(name + PushName(push));
    PushOnce(stage, PushWrench(push, size), answer);
    rest.Restore();
  }
}

}  // namespace regrasp
