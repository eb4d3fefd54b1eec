#include "sim/measure/shake.h"

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "sim/control/grasp_control.h"
#include "sim/measure/push.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

using Eigen::Vector3d;

KeepRest::KeepRest(ReplayWorld& world)
    : world_(world), rest_(world.engine().Save()), forces_(CurrentForces(world)) {
  world.SetSampling(false);
}

KeepRest::~KeepRest() {
  Restore();
  world_.SetSampling(true);
}

void KeepRest::Restore() {
  world_.engine().SetLoad(Vector3d::Zero(), Vector3d::Zero());
  MixForces(world_, forces_, forces_, 0);
  world_.engine().Restore(rest_);
}

namespace {

/// The push, or a share of it, as the object's load.
void Load(ReplayWorld& world, const grasp::Wrench& push_S, double share) {
  const double radius = world.settings().diameter_m / 2;
  world.engine().SetLoad(share * push_S.force, share * radius * push_S.torque_over_radius);
}

void PushAdapted(ReplayWorld& world, const grasp::Wrench& push_S) {
  const HandForces from = CurrentForces(world);
  const HandForces to = PlanHandForces(world, world.HoldingFingers(), push_S, world.half_angle());
  world.Run(kPushRamp, [&](double share) {
    Load(world, push_S, share);
    MixForces(world, from, to, share);
  });
  ComeToRest(world);
}

void PushFixed(ReplayWorld& world, const grasp::Wrench& push_S) {
  world.monitor().SetGiving(true);
  world.Run(kPushRamp, [&](double share) { Load(world, push_S, share); });
  // What swings on the servos for long is not lost, and what slides does not come back.
  (void)WaitUntilStill(world);
  world.MonitorRest();
  world.Run(kPushRamp, [&](double share) { Load(world, push_S, 1 - share); });
  (void)WaitUntilStill(world);
  world.monitor().SetGiving(false);
  world.Step();
  world.MonitorRest();
}

}  // namespace

void PushOnce(ReplayWorld& world, const grasp::Wrench& push_S, DisturbanceResponse response) {
  response == DisturbanceResponse::kAdapted ? PushAdapted(world, push_S) : PushFixed(world, push_S);
}

void Shake(ReplayWorld& world, DisturbanceResponse response,
           const std::function<void(const plan::FaultPush& push)>& on_fault) {
  const double size = world.settings().shake * world.settings().squeeze_N;
  if (size == 0) return;
  const double radius = world.settings().diameter_m / 2;
  const char* how = response == DisturbanceResponse::kAdapted ? "" : " at fixed squeeze";
  KeepRest rest(world);
  for (const Push& push : PushDirections(world.scene().dimension)) {
    const std::string name = PushText(push, size, radius) + how;
    world.monitor().SetPhase("under " + name);
    const grasp::Wrench push_S = PushWrench(push, size);
    PushOnce(world, push_S, response);
    if (world.monitor().reason() != plan::Reason::kNone) {
      on_fault({push_S.force, radius * push_S.torque_over_radius, name});
      return;
    }
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

}  // namespace regrasp::sim
