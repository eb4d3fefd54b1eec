#include "planner/tree/search_space.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/planning/grasp_choice.h"

namespace regrasp {

namespace {

/// The clock is looked at once in about a millisecond.
constexpr std::int64_t kTestsBetweenLooks = 500;

/// Of required half-angles that are only compared, radians.
constexpr double kAngleAccuracy = 1e-5;

/// What rays for a quality cost, in force-closure tests.
constexpr std::int64_t kShotCost = 40;

}  // namespace

SearchSpace::SearchSpace(const Object& object, const GraspDemands& demands)
    : object_(object),
      frame_(object.wrench_frame()),
      demands_(demands),
      half_angle_(demands.half_angle - demands.margin),
      filter_(frame_, demands.half_angle),
      same_point_(kSamePoint * object.diameter()) {
  CheckHalfAngle(demands.half_angle);
  CheckHalfAngle(half_angle());
}

void SearchSpace::SetHalfAngle(double half_angle) {
  CheckHalfAngle(half_angle);
  half_angle_ = half_angle;
  SetUnitForces(units_, half_angle);
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
  if (tests_ >= next_look_) {
    next_look_ = tests_ + kTestsBetweenLooks;
    out_of_time_ = limits_.deadline.IsOver();
  }
  return out_of_time_ || tests_ >= limits_.most_tests;
}

bool SearchSpace::Admits(const ContactSet& set) {
  if (set.size() < fewest_contacts()) return false;
  Known& known = known_[set];
  if (half_angle_ <= known.fails_at || demands_.min_quality >= known.poor_at) return false;
  if (half_angle_ < known.holds_at) {
    UnitContacts contacts;
    for (const int number : set) contacts.push_back(units_[number]);
    const bool holds = Holds(std::move(contacts));
    (holds ? known.holds_at : known.fails_at) = half_angle_;
    if (!holds) return false;
  }
  if (demands_.min_quality <= known.good_at) return true;
  const bool good = IsGood(GraspOf(set));
  (good ? known.good_at : known.poor_at) = demands_.min_quality;
  return good;
}

double SearchSpace::RequiredHalfAngle(const ContactSet& set) {
  Known& known = known_[set];
  if (known.required == kUnknown) {
    const auto required = ComputeRequiredHalfAngle(GraspOf(set), frame_, kAngleAccuracy);
    known.required = required ? required->upper : std::numbers::pi / 2;
  }
  return known.required;
}

bool SearchSpace::IsAdmitted(const Grasp& grasp) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!CanMeet(grasp[i], grasp[j])) return false;
    }
  }
  return HoldsAt(grasp, half_angle()) && IsGood(grasp);
}

bool SearchSpace::HoldsAt(const Grasp& grasp, double half_angle) {
  UnitContacts contacts = MakeUnitContacts(grasp, frame_);
  SetUnitForces(contacts, half_angle);
  return Holds(std::move(contacts));
}

bool SearchSpace::Holds(UnitContacts contacts) {
  ++tests_;
  Recentre(contacts);
  const ForceClosure answer =
      dimension() == 3 ? DecideForceClosure<6>(contacts) : DecideForceClosure<3>(contacts);
  return answer.decision == Decision::kYes;
}

bool SearchSpace::IsGood(const Grasp& grasp) {
  if (demands_.min_quality == 0) return true;
  const std::int64_t before = filter_.shot_count();
  const bool good = filter_.IsClearlyAtLeast(grasp, demands_.min_quality);
  tests_ += kShotCost * (filter_.shot_count() - before);
  return good;
}

}  // namespace regrasp
