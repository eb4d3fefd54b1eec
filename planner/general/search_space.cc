#include "planner/general/search_space.h"

#include <algorithm>
#include <array>

#include "planner/graph/grasp_choice.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/quality.h"
#include "planner/plan/reach.h"

namespace regrasp {

namespace {

/// The clock is looked at once in about a millisecond.
constexpr std::int64_t kTestsBetweenLooks = 500;

}  // namespace

SearchSpace::SearchSpace(const Object& object, const GraspDemands& demands)
    : object_(object),
      frame_(object.wrench_frame()),
      demands_(demands),
      same_point_(kSamePoint * object.diameter()) {
  CheckHalfAngle(demands.half_angle);
  CheckHalfAngle(half_angle());
}

SearchSpace SearchSpace::WithHalfAngle(double half_angle) const {
  GraspDemands demands = demands_;
  demands.margin = demands.half_angle - half_angle;
  SearchSpace space(object_, demands);
  space.contacts_ = contacts_;
  space.units_ = units_;
  SetUnitForces(space.units_, half_angle);
  return space;
}

int SearchSpace::Add(const Contact& contact) {
  const auto known = std::find_if(contacts_.begin(), contacts_.end(), [&](const Contact& other) {
    return other.face == contact.face && other.p == contact.p && other.n == contact.n;
  });
  if (known != contacts_.end()) return static_cast<int>(known - contacts_.begin());
  assert(count() < ContactSet::kMostNumbers);
  contacts_.push_back(contact);
  UnitContacts unit = MakeUnitContacts(std::span(&contact, 1), frame_);
  SetUnitForces(unit, half_angle());
  units_.push_back(unit.front());
  return count() - 1;
}

ContactSet SearchSpace::Add(const Grasp& grasp) {
  ContactSet set;
  for (const Contact& contact : grasp) set.Insert(Add(contact));
  return set;
}

Grasp SearchSpace::GraspOf(const ContactSet& set) const {
  Grasp grasp;
  for (const int number : set) grasp.push_back(contacts_[number]);
  return grasp;
}

bool SearchSpace::CanMeet(const Contact& a, const Contact& b) const {
  if ((a.p - b.p).squaredNorm() <= same_point_ * same_point_) return false;
  return demands_.finger_radius == 0 || KeepApart(std::array{a, b}, demands_.finger_radius);
}

bool SearchSpace::CanMeet(const ContactSet& set, int contact) const {
  return std::all_of(set.begin(), set.end(), [&](int held) { return CanMeet(held, contact); });
}

bool SearchSpace::IsSpent() {
  if (limits_.deadline && tests_ >= next_look_) {
    next_look_ = tests_ + kTestsBetweenLooks;
    out_of_time_ = std::chrono::steady_clock::now() >= *limits_.deadline;
  }
  return out_of_time_ || tests_ >= limits_.most_tests;
}

bool SearchSpace::Admits(const ContactSet& set) {
  if (set.size() < fewest_contacts()) return false;
  const auto [entry, is_new] = known_.try_emplace(set.key(), false);
  if (is_new) entry->second = Test(set);
  return entry->second;
}

bool SearchSpace::IsAdmitted(const Grasp& grasp) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!CanMeet(grasp[i], grasp[j])) return false;
    }
  }
  UnitContacts contacts = MakeUnitContacts(grasp, frame_);
  SetUnitForces(contacts, half_angle());
  return Holds(std::move(contacts)) && IsGood(grasp);
}

bool SearchSpace::Test(const ContactSet& set) {
  UnitContacts contacts;
  for (const int number : set) contacts.push_back(units_[number]);
  return Holds(std::move(contacts)) && (demands_.min_quality == 0 || IsGood(GraspOf(set)));
}

bool SearchSpace::Holds(UnitContacts contacts) {
  ++tests_;
  Recentre(contacts);
  const ForceClosure answer =
      dimension() == 3 ? DecideForceClosure<6>(contacts) : DecideForceClosure<3>(contacts);
  return answer.decision == Decision::kYes;
}

bool SearchSpace::IsGood(const Grasp& grasp) const {
  return demands_.min_quality == 0 ||
         QualityClearlyAtLeast(grasp, frame_, demands_.half_angle, demands_.min_quality);
}

}  // namespace regrasp
