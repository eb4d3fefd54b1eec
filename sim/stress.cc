#include "sim/stress.h"

#include <algorithm>

#include "planner/grasp/largest_load.h"
#include "sim/shake.h"
#include "sim/stage.h"

namespace regrasp {
namespace {

/// The first push that is tried, over the squeeze; doubled as long as the object stands it.
constexpr double kFirstStress = 0.01;

/// No grasp resists more: forces inside the cones sum to less than the squeeze over cos θ, and half
/// angles near 90 degrees, where that is more, are not what a hand has.
constexpr double kMostStress = 10;

/// Whether the object stands a push of `share` of the squeeze.
bool Resists(Stage& stage, KeepRest& rest, const Push& push, double share) {
  stage.StartJudging();
  stage.judge().SetPhase("stress, " + PushName(push));
  bool stands = false;
  try {
    PushOnce(stage, PushWrench(push, share * stage.settings().squeeze_N), Answer::kAdapted);
    stands = stage.judge().reason() == Reason::kNone;
  } catch (const UnstableError&) {
    // A push under which the simulation falls apart is not resisted.
  }
  rest.Restore();
  return stands;
}

double SearchReplay(Stage& stage, KeepRest& rest, const Push& push) {
  double stands = 0;
  double fails = kFirstStress;
  while (fails < kMostStress && Resists(stage, rest, push, fails)) {
    stands = fails;
    fails *= 2;
  }
  while (fails - stands > std::max(kLeastStress, kStressGap * stands)) {
    const double middle = (stands + fails) / 2;
    (Resists(stage, rest, push, middle) ? stands : fails) = middle;
  }
  return stands;
}

double SearchAnalysis(const Stage& stage, const Push& push) {
  Grasp contacts;
  for (const int f : stage.HoldingFingers()) contacts.push_back(stage.fingers()[f].contact);
  if (contacts.empty()) return 0;
  const auto largest = ComputeLargestLoad(contacts, stage.frame_B(), stage.half_angle(),
                                          {stage.weight_S(), {0, 0, 0}}, PushWrench(push, 1),
                                          stage.settings().squeeze_N);
  return largest ? largest->lower : 0;
}

}  // namespace

std::vector<DirectionStress> MeasureStress(Stage& stage) {
  KeepRest rest(stage);
  std::vector<DirectionStress> all;
  for (const Push& push : PushDirections(stage.scene().dimension)) {
    all.push_back({push, SearchReplay(stage, rest, push), SearchAnalysis(stage, push)});
  }
  return all;
}

}  // namespace regrasp
