#pragma once

#include <boost/container/small_vector.hpp>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

/// Contacts as fingertips of one torsion make them (Contact::torsion): a view of copies, and of the
/// contacts themselves where the torsion is 0. The contacts must stay alive.
class SoftContacts {
 public:
  SoftContacts(std::span<const Contact> contacts, double torsion) : view_(contacts) {
    if (torsion == 0) return;
    soft_.assign(contacts.begin(), contacts.end());
    for (Contact& contact : soft_) contact.torsion = torsion;
    view_ = {soft_.data(), soft_.size()};
  }
  SoftContacts(const SoftContacts&) = delete;
  SoftContacts& operator=(const SoftContacts&) = delete;

  [[nodiscard]] std::span<const Contact> view() const { return view_; }

 private:
  boost::container::small_vector<Contact, kInlineContacts> soft_;
  std::span<const Contact> view_;
};

}  // namespace regrasp::grasp
