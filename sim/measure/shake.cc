#include "sim/measure/shake.h"

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/largest_load.h"
#include "sim/control/motions.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

namespace {

/// Return whether an axis exists: in the plane there are two forces and one torque.
bool IsAxis(int dimension, bool turn, int axis) { return dimension == 3 || turn == (axis == 2); }

/// Return "+x" and so on.
std::string AxisName(const Push& push) {
  return std::string(push.sign > 0 ? "+" : "-") + "xyz"[push.axis];
}

}  // namespace

std::vector<Push> PushDirections(int dimension) {
  std::vector<Push> pushes;
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!IsAxis(dimension, turn, axis)) continue;
      for (const double sign : {1.0, -1.0}) pushes.push_back({turn, axis, sign});
    }
  }
  return pushes;
}

std::string PushName(const Push& push) {
  return (push.turn ? "torque " : "force ") + AxisName(push);
}

std::string PushText(const Push& push, double size, double radius) {
  constexpr int kDigits = 2;
  const std::string axis = AxisName(push);
  return push.turn ? "a twist of " + FormatShort(size * radius, kDigits) + " N·m about " + axis
                   : "a push of " + FormatShort(size, kDigits) + " N along " + axis;
}

grasp::Wrench PushWrench(const Push& push, double size) {
  const Eigen::Vector3d along = push.sign * size * Eigen::Vector3d::Unit(push.axis);
  return push.turn ? grasp::Wrench{Eigen::Vector3d::Zero(), along}
                   : grasp::Wrench{along, Eigen::Vector3d::Zero()};
}

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

/// Apply a share of a disturbance as the object's load.
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
  // A long oscillation on the servos is not a loss, and an object that slides does not return.
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
  const char* how = response == DisturbanceResponse::kAdapted ? "" : " at fixed grasp force";
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
  throw InputError("--shake " + FormatShort(settings.shake) +
                   " is too small to detect a lost grasp at --tolerance " +
                   FormatShort(settings.tolerance) + ", expected more than " + FormatShort(least));
}

namespace {

/// First disturbance of the search over the grasp force; it doubles as long as the object resists.
constexpr double kFirstStress = 0.01;

/// Upper limit of the search. Forces inside the cones sum to less than the grasp force over cos θ,
/// so resisting more requires friction angles near 90 degrees, which no hand has.
constexpr double kMostStress = 10;

/// Return whether the grasp resists a disturbance of `share` of the grasp force.
bool Resists(ReplayWorld& world, KeepRest& rest, const Push& push, double share) {
  world.StartMonitoring();
  bool stands = false;
  try {
    PushOnce(world, PushWrench(push, share * world.settings().squeeze_N),
             DisturbanceResponse::kAdapted);
    stands = world.monitor().reason() == plan::Reason::kNone;
  } catch (const UnstableError&) {
    // A disturbance that makes the simulation unstable is not resisted.
  }
  rest.Restore();
  return stands;
}

double SearchReplay(ReplayWorld& world, KeepRest& rest, const Push& push) {
  double stands = 0;
  double fails = kFirstStress;
  while (fails < kMostStress && Resists(world, rest, push, fails)) {
    stands = fails;
    fails *= 2;
  }
  while (fails - stands > std::max(kLeastStress, kStressGap * stands)) {
    const double middle = (stands + fails) / 2;
    (Resists(world, rest, push, middle) ? stands : fails) = middle;
  }
  return stands;
}

double SearchAnalysis(const ReplayWorld& world, const Push& push) {
  grasp::Grasp contacts;
  for (const FingerIndex f : world.HoldingFingers()) contacts.push_back(world.fingers()[f].contact);
  if (contacts.empty()) return 0;
  const auto largest = grasp::ComputeLargestLoad(contacts, world.frame_B(), world.half_angle(),
                                                 {world.weight_S(), {0, 0, 0}}, PushWrench(push, 1),
                                                 world.settings().squeeze_N);
  return largest ? largest->lower : 0;
}

}  // namespace

std::vector<DirectionStress> MeasureStress(ReplayWorld& world) {
  KeepRest rest(world);
  std::vector<DirectionStress> all;
  for (const Push& push : PushDirections(world.scene().dimension)) {
    all.push_back({push, SearchReplay(world, rest, push), SearchAnalysis(world, push)});
  }
  return all;
}

}  // namespace regrasp::sim
