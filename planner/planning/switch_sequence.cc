#include "planner/planning/switch_sequence.h"

#include <algorithm>
#include <stdexcept>

namespace regrasp {

namespace {

bool SameContact(const Contact& a, const Contact& b) { return a.p == b.p && a.n == b.n; }

bool Contains(const Grasp& grasp, const Contact& contact) {
  return std::any_of(grasp.begin(), grasp.end(),
                     [&](const Contact& other) { return SameContact(other, contact); });
}

int LowestFreeFinger(const FingerGrasp& holding, int fingers) {
  for (int finger = 0; finger < fingers; ++finger) {
    const bool holds = std::any_of(holding.begin(), holding.end(),
                                   [&](const FingerContact& c) { return c.finger == finger; });
    if (!holds) return finger;
  }
  throw std::invalid_argument("the hand has too few fingers for the switch");
}

}  // namespace

Switch MakeSwitch(const FingerGrasp& before, const Grasp& after, int fingers) {
  Switch step;
  FingerGrasp holding = before;
  const Grasp contacts_before = ContactsOf(before);
  for (const Contact& contact : after) {
    if (Contains(contacts_before, contact)) continue;
    step.place.push_back({LowestFreeFinger(holding, fingers), contact});
    holding.push_back(step.place.back());
  }
  for (const FingerContact& finger : before) {
    if (!Contains(after, finger.contact)) step.release.push_back(finger.finger);
  }
  return step;
}

Sequence MakeSwitchSequence(std::span<const Grasp> grasps, int fingers) {
  if (grasps.empty()) throw std::invalid_argument("a sequence needs a grasp");
  Sequence sequence;
  for (const Contact& contact : grasps.front()) {
    sequence.initial.push_back({LowestFreeFinger(sequence.initial, fingers), contact});
  }
  FingerGrasp holding = sequence.initial;
  for (const Grasp& grasp : grasps.subspan(1)) {
    Switch step = MakeSwitch(holding, grasp, fingers);
    if (step.place.empty() && step.release.empty()) continue;
    holding = GraspAfter(holding, step);
    sequence.steps.emplace_back(std::move(step));
  }
  return sequence;
}

}  // namespace regrasp
