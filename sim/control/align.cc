#include "sim/control/align.h"

#include <algorithm>
#include <vector>

#include "sim/control/motions.h"
#include "sim/control/roll.h"
#include "sim/control/slide.h"
#include "sim/scene/align_script.h"

namespace regrasp::sim {

namespace {

/// Contacts this close, over D, are one: the finger stays.
constexpr double kSamePoint = 1e-9;

bool Stays(const ReplayWorld& world, const grasp::Contact& from, const grasp::Contact& to) {
  return from.face == to.face && (from.p - to.p).norm() <= kSamePoint * world.settings().diameter_m;
}

std::vector<FingerIndex> FingersOf(const plan::FingerGrasp& grasp) {
  std::vector<FingerIndex> fingers;
  for (const plan::FingerContact& held : grasp) fingers.push_back(held.finger);
  return fingers;
}

/// The verdict stands; to go on with an object that is lost takes long and tells nothing.
bool HasFailed(ReplayWorld& world) { return world.monitor().reason() != plan::Reason::kNone; }

void HandOver(ReplayWorld& world, const FingerHandover& move) {
  SwitchFingers(world, move.support_fingers, FingersOf(move.targets));
  SwitchFingers(world, move.targets, FingersOf(move.support_fingers));
}

/// The finger that the others balance best goes first.
void Slide(ReplayWorld& world, const plan::FingerGrasp& from, const plan::FingerGrasp& to) {
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!Stays(world, from[i].contact, to[i].contact)) waiting.push_back(i);
  }
  while (!waiting.empty()) {
    const auto next = std::ranges::max_element(waiting, {}, [&](std::size_t i) {
      return SlideMargin(world, from[i].finger, from[i].contact, to[i].contact);
    });
    SlideFinger(world, from[*next].finger, from[*next].contact, to[*next].contact);
    waiting.erase(next);
  }
}

}  // namespace

AlignMode PerformAlign(ReplayWorld& world, const AlignScript& script_B) {
  bool handed_over = false;
  bool slid = false;
  for (const AlignMove& move : script_B.moves) {
    if (HasFailed(world)) break;
    if (const auto* fingers = std::get_if<FingerHandover>(&move)) {
      handed_over = true;
      HandOver(world, *fingers);
    } else if (const auto* roll = std::get_if<FingersRoll>(&move)) {
      slid = true;
      RollFingers(world, roll->from, roll->to);
    } else {
      slid = true;
      const auto& grasps = std::get<FingersSlide>(move).grasps;
      for (std::size_t i = 1; i < grasps.size() && !HasFailed(world); ++i) {
        Slide(world, grasps[i - 1], grasps[i]);
      }
    }
  }
  if (!slid) return AlignMode::kImitated;
  return handed_over ? AlignMode::kMixed : AlignMode::kSlid;
}

void TellMoved(ReplayWorld& world, const std::vector<plan::FingerGrasp>& waypoints_B) {
  for (WorldFinger& finger : world.fingers()) {
    finger.role = finger.holding ? plan::FingerRole::kHolding : plan::FingerRole::kFree;
  }
  for (const plan::FingerContact& start : waypoints_B.front()) {
    const plan::FingerContact* end = plan::FindFinger(waypoints_B.back(), start.finger);
    if (end == nullptr || Stays(world, start.contact, end->contact)) continue;
    WorldFinger& finger = world.fingers()[start.finger];
    finger.role = plan::FingerRole::kMoved;
    finger.path_B.clear();
    for (const plan::FingerGrasp& grasp_B : waypoints_B) {
      const plan::FingerContact* at = plan::FindFinger(grasp_B, start.finger);
      if (at != nullptr) finger.path_B.push_back(at->contact.p);
    }
  }
}

}  // namespace regrasp::sim
