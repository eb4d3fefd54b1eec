#include "planner/criteria/grasp_memory.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace regrasp::criteria {

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
