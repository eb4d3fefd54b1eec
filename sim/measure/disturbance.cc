#include "sim/measure/disturbance.h"

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"
#include "sim/control/slide.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

namespace {

/// Return whether an axis exists: in the plane there are two forces and one torque.
bool IsAxis(int dimension, bool turn, int axis) { return dimension == 3 || turn == (axis == 2); }

/// Return "+x" and so on.
std::string AxisName(const Disturbance& disturbance) {
  return std::string(disturbance.sign > 0 ? "+" : "-") + "xyz"[disturbance.axis];
}

}  // namespace

std::vector<Disturbance> DisturbanceDirections(int dimension) {
  std::vector<Disturbance> disturbances;
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!IsAxis(dimension, turn, axis)) continue;
      for (const double sign : {1.0, -1.0}) disturbances.push_back({turn, axis, sign});
    }
  }
  return disturbances;
}

std::string DisturbanceName(const Disturbance& disturbance) {
  return (disturbance.turn ? "torque " : "force ") + AxisName(disturbance);
}

std::string DisturbanceText(const Disturbance& disturbance, double size, double radius) {
  constexpr int kDigits = 2;
  const std::string axis = AxisName(disturbance);
  return disturbance.turn
             ? "a torque of " + FormatShort(size * radius, kDigits) + " N·m about " + axis
             : "a disturbance force of " + FormatShort(size, kDigits) + " N along " + axis;
}

grasp::Wrench DisturbanceWrench(const Disturbance& disturbance, double size) {
  const Eigen::Vector3d along = disturbance.sign * size * Eigen::Vector3d::Unit(disturbance.axis);
  return disturbance.turn ? grasp::Wrench{Eigen::Vector3d::Zero(), along}
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
void Load(ReplayWorld& world, const grasp::Wrench& wrench_S, double share) {
  const double radius = world.settings().diameter_m / 2;
  world.engine().SetLoad(share * wrench_S.force, share * radius * wrench_S.torque_over_radius);
}

void DisturbAdapted(ReplayWorld& world, const grasp::Wrench& wrench_S) {
  const HandForces from = CurrentForces(world);
  const HandForces to =
      PlanHandForces(world, world.HoldingFingers(), wrench_S, world.friction_angle());
  world.Run(kDisturbanceRamp, [&](double share) {
    Load(world, wrench_S, share);
    MixForces(world, from, to, share);
  });
  ComeToRest(world);
}

void DisturbFixed(ReplayWorld& world, const grasp::Wrench& wrench_S) {
  world.monitor().SetGiving(true);
  world.Run(kDisturbanceRamp, [&](double share) { Load(world, wrench_S, share); });
  // A long oscillation on the servos is not a loss, and an object that slides does not return.
  (void)WaitUntilStill(world);
  world.MonitorRest();
  world.Run(kDisturbanceRamp, [&](double share) { Load(world, wrench_S, 1 - share); });
  (void)WaitUntilStill(world);
  world.monitor().SetGiving(false);
  world.Step();
  world.MonitorRest();
}

}  // namespace

void DisturbOnce(ReplayWorld& world, const grasp::Wrench& wrench_S, DisturbanceResponse response) {
  response == DisturbanceResponse::kAdapted ? DisturbAdapted(world, wrench_S)
                                            : DisturbFixed(world, wrench_S);
}

void ApplyDisturbances(
    ReplayWorld& world, DisturbanceResponse response,
    const std::function<void(const plan::FaultDisturbance& disturbance)>& on_fault) {
  const double size = world.settings().disturbance_ratio * world.settings().grasp_force_N;
  if (size == 0) return;
  const double radius = world.settings().diameter_m / 2;
  const char* how = response == DisturbanceResponse::kAdapted ? "" : " at fixed grasp force";
  KeepRest rest(world);
  for (const Disturbance& disturbance : DisturbanceDirections(world.scene().dimension)) {
    const std::string name = DisturbanceText(disturbance, size, radius) + how;
    world.monitor().SetPhase("under " + name);
    const grasp::Wrench wrench_S = DisturbanceWrench(disturbance, size);
    DisturbOnce(world, wrench_S, response);
    if (world.monitor().reason() != plan::Reason::kNone) {
      on_fault({wrench_S.force, radius * wrench_S.torque_over_radius, name});
      return;
    }
    rest.Restore();
  }
}

double LeastDisturbance(double tolerance) {
  return std::max(tolerance / FreeMotion(kDisturbanceRamp), 2 * kStill / (kStillTime * kStillTime));
}

void CheckDisturbance(const ReplaySettings& settings) {
  const double least = LeastDisturbance(settings.tolerance);
  if (settings.disturbance_ratio == 0 || settings.disturbance_ratio > least) return;
  throw InputError("--disturbance " + FormatShort(settings.disturbance_ratio) +
                   " is too small to detect a lost grasp at --tolerance " +
                   FormatShort(settings.tolerance) + ", expected more than " + FormatShort(least));
}

namespace {

/// First disturbance of the search over the grasp force; it doubles as long as the object resists.
constexpr double kFirstResisted = 0.01;

/// Upper limit of the search. Forces inside the cones sum to less than the grasp force over cos θ,
/// so resisting more requires friction angles near 90 degrees, which no hand has.
constexpr double kMostResisted = 10;

/// Return whether the grasp resists a disturbance of `share` of the grasp force.
bool Resists(ReplayWorld& world, KeepRest& rest, const Disturbance& disturbance, double share) {
  world.StartMonitoring();
  bool stands = false;
  try {
    DisturbOnce(world, DisturbanceWrench(disturbance, share * world.settings().grasp_force_N),
                DisturbanceResponse::kAdapted);
    stands = world.monitor().reason() == plan::Reason::kNone;
  } catch (const UnstableError&) {
    // A disturbance that makes the simulation unstable is not resisted.
  }
  rest.Restore();
  return stands;
}

double SearchReplay(ReplayWorld& world, KeepRest& rest, const Disturbance& disturbance) {
  double stands = 0;
  double fails = kFirstResisted;
  while (fails < kMostResisted && Resists(world, rest, disturbance, fails)) {
    stands = fails;
    fails *= 2;
  }
  while (fails - stands > std::max(kLeastResisted, kResistedGap * stands)) {
    const double middle = (stands + fails) / 2;
    (Resists(world, rest, disturbance, middle) ? stands : fails) = middle;
  }
  return stands;
}

double SearchAnalysis(const ReplayWorld& world, const Disturbance& disturbance) {
  grasp::Grasp contacts;
  for (const FingerIndex f : world.HoldingFingers()) contacts.push_back(world.fingers()[f].contact);
  if (contacts.empty()) return 0;
  const auto largest = grasp::ComputeLargestLoad(
      contacts, world.frame_B(), world.friction_angle(), {world.weight_S(), {0, 0, 0}},
      DisturbanceWrench(disturbance, 1), world.settings().grasp_force_N);
  return largest ? largest->lower : 0;
}

}  // namespace

std::vector<ResistedWrench> MeasureResistedWrenches(ReplayWorld& world) {
  KeepRest rest(world);
  std::vector<ResistedWrench> all;
  for (const Disturbance& disturbance : DisturbanceDirections(world.scene().dimension)) {
    all.push_back(
        {disturbance, SearchReplay(world, rest, disturbance), SearchAnalysis(world, disturbance)});
  }
  return all;
}

std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& projected, plan::EntryIndex index) {
  if (index == 0) return {projected.initial};
  plan::FingerGrasp before = projected.initial;
  for (plan::EntryIndex earlier{1}; earlier < index; ++earlier) {
    before = plan::GraspAfter(before, plan::StepOf(projected, earlier));
  }
  const plan::Step& step = plan::StepOf(projected, index);
  if (const auto* align = std::get_if<plan::Align>(&step)) return align->waypoints;
  return {before, plan::GraspAfter(before, step)};
}

std::optional<NeedOfFinger> WeakestFingers::OfEntry(plan::EntryIndex index) {
  std::optional<NeedOfFinger> weakest;
  for (const plan::FingerGrasp& grasp : GraspsOfEntry(projected_, index)) {
    const std::optional<NeedOfFinger> need = OfGrasp(grasp);
    if (!need) continue;
    if (!weakest || grasp::WeakestFinger({weakest->friction, need->friction}) == 1) weakest = need;
  }
  return weakest;
}

std::optional<NeedOfFinger> WeakestFingers::OfGrasp(const plan::FingerGrasp& grasp) {
  if (plan::AreIdentical(grasp, last_)) return last_weakest_;
  last_ = grasp;
  last_weakest_.reset();
  if (grasp.empty()) return last_weakest_;
  const auto found = grasp::FindWeakestFinger(plan::ContactsOf(grasp), frame_, friction_angle_);
  if (found) last_weakest_ = {grasp[found->finger].finger, found->friction};
  return last_weakest_;
}

}  // namespace regrasp::sim
