#include "sim/measure/stress.h"

#include <algorithm>

#include "planner/grasp/largest_load.h"
#include "sim/measure/push.h"
#include "sim/measure/shake.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {
namespace {

/// The first push that is tried, over the squeeze; doubled as long as the object stands it.
constexpr double kFirstStress = 0.01;

/// No grasp resists more: forces inside the cones sum to less than the squeeze over cos θ, and half
/// angles near 90 degrees, where that is more, are not what a hand has.
constexpr double kMostStress = 10;

/// Whether the object stands a push of `share` of the squeeze.
bool Resists(ReplayWorld& world, KeepRest& rest, const Push& push, double share) {
  world.StartMonitoring();
  bool stands = false;
  try {
    PushOnce(world, PushWrench(push, share * world.settings().squeeze_N),
             DisturbanceResponse::kAdapted);
    stands = world.monitor().reason() == plan::Reason::kNone;
  } catch (const UnstableError&) {
    // A push under which the simulation falls apart is not resisted.
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
