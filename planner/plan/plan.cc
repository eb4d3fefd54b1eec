#include "planner/plan/plan.h"

#include <algorithm>

#include "planner/motion/contact_motion.h"

namespace regrasp::plan {

namespace {

void SetTorsion(double torsion, FingerGrasp& grasp) {
  for (FingerContact& held : grasp) held.contact.torsion = torsion;
}

}  // namespace

void SetTorsion(double torsion, Plan& plan) {
  plan.torsion = torsion;
  SetTorsion(torsion, plan.initial);
  for (Step& step : plan.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      SetTorsion(torsion, finger_switch->place);
    } else if (auto* align = std::get_if<Align>(&step)) {
      for (FingerGrasp& waypoint : align->waypoints) SetTorsion(torsion, waypoint);
    }
  }
  for (grasp::Contact& contact : plan.goal) contact.torsion = torsion;
}

const char* StepKind(const Step& step) {
  if (std::holds_alternative<Switch>(step)) return "switch";
  return std::holds_alternative<Align>(step) ? "align" : "move";
}

const FingerContact* FindFinger(const FingerGrasp& grasp, FingerIndex finger) {
  const auto found = std::ranges::find(grasp, finger, &FingerContact::finger);
  return found == grasp.end() ? nullptr : &*found;
}

FingerGrasp GraspAfter(const FingerGrasp& before, const Step& step) {
  if (const auto* align = std::get_if<Align>(&step)) {
    return align->waypoints.empty() ? before : align->waypoints.back();
  }
  if (std::holds_alternative<Move>(step)) return before;
  const auto& finger_switch = std::get<Switch>(step);
  FingerGrasp after = before;
  std::erase_if(after, [&](const FingerContact& held) {
    return std::ranges::find(finger_switch.release, held.finger) != finger_switch.release.end();
  });
  after.insert(after.end(), finger_switch.place.begin(), finger_switch.place.end());
  return after;
}

FingerGrasp GraspBetween(const FingerGrasp& from, const FingerGrasp& to, double share) {
  FingerGrasp between = from;
  for (FingerContact& held : between) {
    const FingerContact* next = FindFinger(to, held.finger);
    if (next == nullptr) continue;
    held.contact = motion::ContactMotion(held.contact, next->contact).At(share);
  }
  return between;
}

FingerGrasp FingersInOrder(const grasp::Grasp& grasp) {
  FingerGrasp held;
  for (FingerIndex finger{0}; finger < std::ssize(grasp); ++finger) {
    held.push_back({finger, grasp[finger]});
  }
  return held;
}

grasp::Grasp ContactsOf(const FingerGrasp& grasp) {
  grasp::Grasp contacts;
  contacts.reserve(grasp.size());
  for (const FingerContact& held : grasp) contacts.push_back(held.contact);
  return contacts;
}

}  // namespace regrasp::plan
