#include "planner/plan/snapshot.h"

#include <algorithm>

namespace regrasp::plan {

namespace {

bool Has(const std::vector<FingerIndex>& fingers, FingerIndex finger) {
  return std::ranges::find(fingers, finger) != fingers.end();
}

FingerGrasp GraspBefore(const Plan& plan, int entry) {
  FingerGrasp grasp = plan.initial;
  for (int step = 1; step < entry; ++step) grasp = GraspAfter(grasp, plan.steps[step - 1]);
  return grasp;
}

/// Select the fingers that are drawn.
FingerGrasp Select(FingerGrasp grasp, const Fault& fault) {
  std::ranges::stable_partition(
      grasp, [&](const FingerContact& held) { return Has(fault.fingers, held.finger); });
  if (std::ssize(grasp) > kMostDrawnFingers) grasp.resize(kMostDrawnFingers);
  return grasp;
}

FingerState StateOf(const FingerContact& held, FingerRole role) {
  return {held.finger, role, held.contact.p, held.contact.p, held.contact.n};
}

std::vector<FingerState> DuringSwitch(const FingerGrasp& before, const Switch& step,
                                      const Fault& fault) {
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(before, fault)) {
    const bool released = Has(step.release, held.finger);
    states.push_back(StateOf(held, released ? FingerRole::kReleased : FingerRole::kHolding));
  }
  for (const FingerContact& placed : Select(step.place, fault)) {
    states.push_back(StateOf(placed, FingerRole::kPlaced));
  }
  return states;
}

/// Return the state of a finger on its path from the first waypoint to `waypoint`.
FingerState OnItsWay(const FingerContact& held, const Align& step, int waypoint) {
  FingerState state = StateOf(held, FingerRole::kMoved);
  for (int w = 0; w <= waypoint; ++w) {
    const FingerContact* there = FindFinger(step.waypoints[w], held.finger);
    if (there != nullptr) state.path_W.push_back(there->contact.p);
  }
  state.path_W.push_back(held.contact.p);
  if (state.path_W.front() != state.path_W.back()) return state;
  return StateOf(held, FingerRole::kHolding);
}

std::vector<FingerState> DuringAlign(const FingerGrasp& before, const Align& step,
                                     const Fault& fault) {
  const int last = static_cast<int>(step.waypoints.size()) - 1;
  const int waypoint = fault.waypoint < 0 ? last : std::min(fault.waypoint, last);
  const FingerGrasp& planned = last < 0 ? before : step.waypoints[waypoint];
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(fault.grasp.empty() ? planned : fault.grasp, fault)) {
    states.push_back(OnItsWay(held, step, waypoint));
  }
  return states;
}

std::vector<FingerState> AtHold(const FingerGrasp& grasp, const Fault& fault) {
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(grasp, fault)) {
    states.push_back(StateOf(held, FingerRole::kHolding));
  }
  return states;
}

std::vector<FingerState> DuringEntry(const Plan& plan, int entry, const Fault& fault) {
  if (entry == 0) return AtHold(plan.initial, fault);
  const Step& step = plan.steps[entry - 1];
  const FingerGrasp before = GraspBefore(plan, entry);
  if (const auto* change = std::get_if<Switch>(&step)) return DuringSwitch(before, *change, fault);
  if (const auto* align = std::get_if<Align>(&step)) return DuringAlign(before, *align, fault);
  return AtHold(before, fault);
}

}  // namespace

Snapshot MakePlannedSnapshot(const Plan& projected, int entry, const Fault& fault,
                             double fingertip_radius_m) {
  Snapshot snapshot;
  snapshot.fingertip_radius_m = fingertip_radius_m;
  snapshot.fingers = DuringEntry(projected, entry, fault);
  for (FingerState& state : snapshot.fingers) {
    state.contact_W *= projected.scale;
    state.tip_W = state.contact_W - fingertip_radius_m * state.normal_W;
    for (Eigen::Vector3d& p : state.path_W) p *= projected.scale;
  }
  return snapshot;
}

}  // namespace regrasp::plan
