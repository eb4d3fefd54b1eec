#include "planner/criteria/grasp_evaluator.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>
#include <stdexcept>

#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::criteria {

namespace {

/// Return a key of a grasp that is independent of the order of its contacts. Sets order contacts by
/// faces, sequences by fingers.
std::vector<double> NumbersOf(const grasp::Grasp& grasp) {
  using Numbers = std::array<double, 7>;
  std::vector<Numbers> contacts;
  contacts.reserve(grasp.size());
  for (const auto& [p, n, face, torsion] : grasp) {
    contacts.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), static_cast<double>(face)});
  }
  std::ranges::sort(contacts);
  std::vector<double> numbers;
  numbers.reserve(contacts.size() * std::tuple_size_v<Numbers>);
  for (const Numbers& contact : contacts) {
    numbers.insert(numbers.end(), contact.begin(), contact.end());
  }
  return numbers;
}

}  // namespace

GraspEvaluator::GraspEvaluator(const object::Object& object, const GraspCriteria& criteria,
                               const hand::Hand& hand, QualityTest quality)
    : object_(object),
      frame_(object.wrench_frame()),
      asked_(criteria),
      criteria_(criteria),
      asks_more_(criteria.AsksMore()),
      hand_(hand),
      quality_(quality),
      same_point_(kSamePoint * object.diameter()),
      friction_angle_(criteria.friction_angle),
      filter_(frame_, criteria.friction_angle) {}

void GraspEvaluator::SetFrictionAngle(double friction_angle) {
  grasp::CheckFrictionAngle(friction_angle);
  friction_angle_ = friction_angle;
}

void GraspEvaluator::SetShare(double share) {
  share_ = share;
  criteria_ = asked_.Relaxed(share);
  asks_more_ = criteria_.AsksMore();
}

bool GraspEvaluator::CanAllMeet(Contacts grasp) const {
  return criteria::CanAllMeet(grasp, same_point_, finger_radius());
}

bool GraspEvaluator::AreReachable(Contacts contacts) const {
  return std::ranges::all_of(contacts, [&](const grasp::Contact& contact) {
    return CanRest(object_, contact) && CanReach(object_, contact, finger_radius());
  });
}

bool GraspEvaluator::IsReachable(const grasp::Grasp& grasp) const {
  return CanAllMeet(grasp) && AreReachable(grasp);
}

bool GraspEvaluator::HoldsAt(Contacts grasp, double friction_angle) const {
  ++counts_.force_closure;
  const grasp::SoftContacts felt(grasp, torsion());
  grasp::UnitContacts contacts = grasp::MakeUnitContacts(felt.view(), frame_);
  grasp::SetUnitForces(contacts, friction_angle);
  grasp::Recentre(contacts);
  const grasp::ForceClosure answer = dimension() == 3 ? grasp::DecideForceClosure<6>(contacts)
                                                      : grasp::DecideForceClosure<3>(contacts);
  return answer.decision == grasp::Decision::kYes;
}

bool GraspEvaluator::MeetsCriteria(Contacts grasp) const {
  if (!asks_more_) return true;
  ++counts_.criteria;
  const grasp::SoftContacts felt(grasp, torsion());
  return criteria::MeetsCriteria(felt.view(), frame_, criteria_,
                                 quality_ == QualityTest::kQuick ? &filter_ : nullptr);
}

bool GraspEvaluator::IsAdmitted(const grasp::Grasp& grasp) const {
  // The cheapest and most selective tests come first.
  return CanAllMeet(grasp) && HoldsAt(grasp, friction_angle_) && MeetsCriteria(grasp);
}

bool GraspEvaluator::IsGood(const grasp::Grasp& grasp) const {
  return IsAdmitted(grasp) && AreReachable(grasp);
}

bool GraspEvaluator::WorkOut(Contacts grasp, KnownGrasp& known) const {
  if (friction_angle_ < known.holds_at) {
    const bool holds = HoldsAt(grasp, friction_angle_) && CanAllMeet(grasp);
    (holds ? known.holds_at : known.fails_at) = friction_angle_;
    if (!holds) return false;
  }
  if (share_ <= known.good_at || !asks_more_) return true;
  const bool good = MeetsCriteria(grasp);
  (good ? known.good_at : known.poor_at) = share_;
  return good;
}

double GraspEvaluator::ComputeRequired(Contacts grasp, double accuracy) const {
  const grasp::SoftContacts felt(grasp, torsion());
  const auto required = grasp::ComputeRequiredFrictionAngle(felt.view(), frame_, accuracy);
  return required ? required->upper : std::numbers::pi / 2;
}

KnownGrasp& GraspEvaluator::Know(const grasp::Grasp& grasp) const {
  const auto [entry, is_new] = known_.try_emplace(NumbersOf(grasp));
  if (is_new && !AreReachable(grasp)) entry->second.fails_at = KnownGrasp::kInfinity;
  return entry->second;
}

std::optional<double> GraspEvaluator::Margin(const grasp::Grasp& grasp) const {
  const auto contacts = [&] { return Contacts(grasp); };
  KnownGrasp& known = Know(grasp);
  if (!Admits(known, contacts)) return std::nullopt;
  return std::max(friction_angle_ - RequiredFrictionAngle(known, contacts), 0.0);
}

double GraspEvaluator::Score(const grasp::Grasp& grasp) const {
  if (const auto margin = Margin(grasp)) return *margin;
  KnownGrasp& known = Know(grasp);
  if (share_ < known.poor_at) return -1;
  const grasp::SoftContacts felt(grasp, torsion());
  if (known.shortfall == 0) known.shortfall = Shortfall(felt.view(), frame_, asked_);
  return known.shortfall;
}

int GraspMemory::Add(const grasp::Contact& contact) {
  const auto known =
      std::find_if(contacts_.begin(), contacts_.end(), [&](const grasp::Contact& other) {
        return other.face == contact.face && other.p == contact.p && other.n == contact.n;
      });
  if (known != contacts_.end()) return static_cast<int>(known - contacts_.begin());
  assert(count() < ContactSet::kMostNumbers);
  contacts_.push_back(contact);
  contacts_.back().torsion = torsion();
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
  for (const grasp::Contact& contact : contacts) {
    contacts_.push_back(contact);
    contacts_.back().torsion = torsion();
  }
}

GraspMemory::HeldContacts GraspMemory::ContactsOf(const ContactSet& set) const {
  HeldContacts held;
  for (const int number : set) held.push_back(contacts_[number]);
  return held;
}

grasp::Grasp GraspMemory::GraspOf(const ContactSet& set) const {
  const HeldContacts held = ContactsOf(set);
  return {held.begin(), held.end()};
}

bool GraspMemory::CanMeet(const ContactSet& set, int contact) const {
  return std::all_of(set.begin(), set.end(), [&](int held) { return CanMeet(held, contact); });
}

}  // namespace regrasp::criteria
