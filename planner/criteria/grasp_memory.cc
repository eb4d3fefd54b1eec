#include "planner/criteria/grasp_memory.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp {

namespace {

/// Of required half-angles that are only compared, radians.
constexpr double kAngleAccuracy = 1e-5;

}  // namespace

GraspMemory::GraspMemory(const WrenchFrame& frame, double same_point, const GraspCriteria& criteria,
                         const Hand& hand, QualityTest quality)
    : frame_(frame),
      same_point_(same_point),
      criteria_(criteria),
      finger_radius_(hand.fingertip_radius),
      quality_(quality),
      half_angle_(criteria.half_angle),
      filter_(frame, criteria.half_angle) {}

void GraspMemory::SetHalfAngle(double half_angle) {
  CheckHalfAngle(half_angle);
  half_angle_ = half_angle;
  SetUnitForces(units_, half_angle);
}

int GraspMemory::Add(const Contact& contact) {
  const auto known = std::find_if(contacts_.begin(), contacts_.end(), [&](const Contact& other) {
    return other.face == contact.face && other.p == contact.p && other.n == contact.n;
  });
  if (known != contacts_.end()) return static_cast<int>(known - contacts_.begin());
  assert(count() < ContactSet::kMostNumbers);
  Append(std::span(&contact, 1));
  return count() - 1;
}

ContactSet GraspMemory::Add(const Grasp& grasp) {
  ContactSet set;
  for (const Contact& contact : grasp) set.Insert(Add(contact));
  return set;
}

void GraspMemory::Append(std::span<const Contact> contacts) {
  if (contacts_.size() + contacts.size() > ContactSet::kMostNumbers) {
    throw std::invalid_argument("too many contact points");
  }
  contacts_.insert(contacts_.end(), contacts.begin(), contacts.end());
  UnitContacts units = MakeUnitContacts(contacts, frame_);
  SetUnitForces(units, half_angle_);
  units_.insert(units_.end(), units.begin(), units.end());
}

Grasp GraspMemory::GraspOf(const ContactSet& set) const {
  Grasp grasp;
  for (const int number : set) grasp.push_back(contacts_[number]);
  return grasp;
}

bool GraspMemory::CanMeet(const ContactSet& set, int contact) const {
  return std::all_of(set.begin(), set.end(), [&](int held) { return CanMeet(held, contact); });
}

bool GraspMemory::Admits(const ContactSet& set) {
  if (set.size() < fewest_contacts()) return false;
  Known& known = known_[set];
  if (half_angle_ <= known.fails_at || min_quality() >= known.poor_at) return false;
  if (half_angle_ < known.holds_at) {
    UnitContacts contacts;
    for (const int number : set) contacts.push_back(units_[number]);
    const bool holds = Holds(std::move(contacts)) && CanAllMeet(GraspOf(set));
    (holds ? known.holds_at : known.fails_at) = half_angle_;
    if (!holds) return false;
  }
  if (min_quality() <= known.good_at || !criteria_.AsksMore()) return true;
  const bool good = IsGoodEnough(GraspOf(set));
  (good ? known.good_at : known.poor_at) = min_quality();
  return good;
}

double GraspMemory::RequiredHalfAngle(const ContactSet& set) {
  Known& known = known_[set];
  if (known.required == kUnknown) {
    const auto required = ComputeRequiredHalfAngle(GraspOf(set), frame_, kAngleAccuracy);
    known.required = required ? required->upper : std::numbers::pi / 2;
  }
  return known.required;
}

bool GraspMemory::CanAllMeet(const Grasp& grasp) const {
  return regrasp::CanAllMeet(grasp, same_point_, finger_radius_);
}

bool GraspMemory::IsAdmitted(const Grasp& grasp) {
  return CanAllMeet(grasp) && HoldsAt(grasp, half_angle_) &&
         (!criteria_.AsksMore() || IsGoodEnough(grasp));
}

bool GraspMemory::HoldsAt(const Grasp& grasp, double half_angle) {
  UnitContacts contacts = MakeUnitContacts(grasp, frame_);
  SetUnitForces(contacts, half_angle);
  return Holds(std::move(contacts));
}

bool GraspMemory::Holds(UnitContacts contacts) {
  ++counts_.force_closure;
  Recentre(contacts);
  const ForceClosure answer =
      dimension() == 3 ? DecideForceClosure<6>(contacts) : DecideForceClosure<3>(contacts);
  return answer.decision == Decision::kYes;
}

bool GraspMemory::IsGoodEnough(const Grasp& grasp) {
  ++counts_.criteria;
  return MeetsCriteria(grasp, frame_, criteria_,
                       quality_ == QualityTest::kQuick ? &filter_ : nullptr);
}

}  // namespace regrasp
