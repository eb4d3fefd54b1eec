#include "planner/planning/switch_sequence.h"

#include <algorithm>
#include <stdexcept>

namespace regrasp::planning {

namespace {

bool SameContact(const grasp::Contact& a, const grasp::Contact& b) {
  return a.p == b.p && a.n == b.n;
}

bool Contains(const grasp::Grasp& grasp, const grasp::Contact& contact) {
  return std::any_of(grasp.begin(), grasp.end(),
                     [&](const grasp::Contact& other) { return SameContact(other, contact); });
}

FingerIndex LowestFreeFinger(const plan::FingerGrasp& holding, int fingers) {
  for (FingerIndex finger{0}; finger < fingers; ++finger) {
    if (plan::FindFinger(holding, finger) == nullptr) return finger;
  }
  throw std::invalid_argument("the hand has too few fingers for the switch");
}

}  // namespace

plan::Switch MakeSwitch(const plan::FingerGrasp& before, const grasp::Grasp& after, int fingers) {
  plan::Switch step;
  plan::FingerGrasp holding = before;
  const grasp::Grasp contacts_before = plan::ContactsOf(before);
  for (const grasp::Contact& contact : after) {
    if (Contains(contacts_before, contact)) continue;
    step.place.push_back({LowestFreeFinger(holding, fingers), contact});
    holding.push_back(step.place.back());
  }
  for (const plan::FingerContact& finger : before) {
    if (!Contains(after, finger.contact)) step.release.push_back(finger.finger);
  }
  return step;
}

CandidateSequence MakeSwitchSequence(std::span<const grasp::Grasp> grasps, int fingers) {
  if (grasps.empty()) throw std::invalid_argument("a sequence needs a grasp");
  CandidateSequence sequence;
  sequence.initial = MakeSwitch({}, grasps.front(), fingers).place;
  sequence.rests = {{grasps.front(), std::nullopt}};
  plan::FingerGrasp holding = sequence.initial;
  for (const grasp::Grasp& grasp : grasps.subspan(1)) {
    plan::Switch step = MakeSwitch(holding, grasp, fingers);
    if (step.place.empty() && step.release.empty()) continue;
    holding = plan::GraspAfter(holding, step);
    sequence.steps.emplace_back(std::move(step));
    sequence.rests.push_back({grasp, std::nullopt});
  }
  return sequence;
}

}  // namespace regrasp::planning
