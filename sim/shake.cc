#include "sim/shake.h"

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "sim/grasp_control.h"
#include "sim/push.h"
#include "sim/stillness.h"

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
  stage.Run(kPushRamp, [&](double share) {
    Load(stage, push_S, share);
    MixForces(stage, from, to, share);
  });
  ComeToRest(stage);
}

void PushFixed(Stage& stage, const Wrench& push_S) {
  stage.judge().SetGiving(true);
  stage.Run(kPushRamp, [&](double share) { Load(stage, push_S, share); });
  // What swings on the servos for long is not lost, and what slides does not come back.
  (void)WaitUntilStill(stage);
  stage.JudgeRest();
  stage.Run(kPushRamp, [&](double share) { Load(stage, push_S, 1 - share); });
  (void)WaitUntilStill(stage);
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
    if (stage.judge().reason() != Reason::kNone) return;
    rest.Restore();
  }
}

double LeastShake(double tolerance) {
  return std::max(tolerance / FreeMotion(kPushRamp), 2 * kStill / (kStillTime * kStillTime));
}

void CheckShake(const ReplaySettings& settings) {
  const double least = LeastShake(settings.tolerance);
  if (settings.shake == 0 || settings.shake > least) return;
  throw InputError("replay: a body that nothing holds would stand a shake of " +
                   FormatShort(settings.shake) + " (--shake) with a tolerance of " +
                   FormatShort(settings.tolerance) +
                   " (--tolerance); the shake has to be larger than " + FormatShort(least));
}

}  // namespace regrasp
