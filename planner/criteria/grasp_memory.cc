#include "planner/criteria/grasp_memory.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp::criteria {

namespace {

/// Of required half-angles that are only compared, radians.
constexpr double kAngleAccuracy = 1e-5;

}  // namespace

GraspMemory::GraspMemory(const object::WrenchFrame& frame, double same_point,
                         const GraspCriteria& criteria, const hand::Hand& hand, QualityTest quality)
    : frame_(frame),
      same_point_(same_point),
      criteria_(criteria),
      finger_radius_(hand.fingertip_radius),
      quality_(quality),
      half_angle_(criteria.half_angle),
      filter_(frame, criteria.half_angle) {}

void GraspMemory::SetHalfAngle(double half_angle) {
  grasp::CheckHalfAngle(half_angle);
  half_angle_ = half_angle;
  grasp::SetUnitForces(units_, half_angle);
}

int GraspMemory::Add(const grasp::Contact& contact) {
  const auto known =
      std::find_if(contacts_.begin(), contacts_.end(), [&](const grasp::Contact& other) {
        return other.face == contact.face && other.p == contact.p && other.n == contact.n;
      });
  if (known != contacts_.end()) return static_cast<int>(known - contacts_.begin());
  assert(count() < ContactSet::kMostNumbers);
  Append(std::span(&contact, 1));
  return count() - 1;
}

ContactSet GraspMemory::Add(const grasp::Grasp& grasp) {
  ContactSet set;
  for (const grasp::Contact& contact : grasp) set.Insert(Add(contact));
  return set;
}

void GraspMemory::Append(std::span<const grasp::Contact> contacts) {
  if (contacts_.size() + contacts.size() > ContactSet::kMostNumbers) {
    throw std::invalid_argument("too many contact points");
  }
  contacts_.insert(contacts_.end(), contacts.begin(), contacts.end());
  grasp::UnitContacts units = grasp::MakeUnitContacts(contacts, frame_);
  grasp::SetUnitForces(units, half_angle_);
  units_.insert(units_.end(), units.begin(), units.end());
}

grasp::Grasp GraspMemory::GraspOf(const ContactSet& set) const {
  grasp::Grasp grasp;
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
    grasp::UnitContacts contacts;
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
    const auto required = grasp::ComputeRequiredHalfAngle(GraspOf(set), frame_, kAngleAccuracy);
    known.required = required ? required->upper : std::numbers::pi / 2;
  }
  return known.required;
}

bool GraspMemory::CanAllMeet(const grasp::Grasp& grasp) const {
  return criteria::CanAllMeet(grasp, same_point_, finger_radius_);
}

bool GraspMemory::IsAdmitted(const grasp::Grasp& grasp) {
  return CanAllMeet(grasp) && HoldsAt(grasp, half_angle_) &&
         (!criteria_.AsksMore() || IsGoodEnough(grasp));
}

bool GraspMemory::HoldsAt(const grasp::Grasp& grasp, double half_angle) {
  grasp::UnitContacts contacts = grasp::MakeUnitContacts(grasp, frame_);
  grasp::SetUnitForces(contacts, half_angle);
  return Holds(std::move(contacts));
}

bool GraspMemory::Holds(grasp::UnitContacts contacts) {
  ++counts_.force_closure;
  grasp::Recentre(contacts);
  const grasp::ForceClosure answer = dimension() == 3 ? grasp::DecideForceClosure<6>(contacts)
                                                      : grasp::DecideForceClosure<3>(contacts);
  return answer.decision == grasp::Decision::kYes;
}

bool GraspMemory::IsGoodEnough(const grasp::Grasp& grasp) {
  ++counts_.criteria;
  return MeetsCriteria(grasp, frame_, criteria_,
                       quality_ == QualityTest::kQuick ? &filter_ : nullptr);
}

}  // namespace regrasp::criteria
