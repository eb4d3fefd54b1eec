#pragma once

#include <boost/container/static_vector.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/criteria/contact_set.h"
#include "planner/criteria/grasp_evaluator.h"

namespace regrasp::criteria {

/// Numbered contacts, and what is known of the sets of them: evaluated when first asked, then
/// remembered. Contacts are reachable (GraspEvaluator) before they come here.
class GraspMemory : public GraspEvaluator {
 public:
  using GraspEvaluator::GraspEvaluator;

  /// @param contact  knows its face. @returns its number, the old one where it is known.
  int Add(const grasp::Contact& contact);
  [[nodiscard]] ContactSet Add(const grasp::Grasp& grasp);
  /// Adds contacts under the next numbers, whether they are known or not.
  /// @throws std::invalid_argument  there would be more than ContactSet::kMostNumbers.
  void Append(std::span<const grasp::Contact> contacts);
  /// Whether another grasp's contacts can be added.
  [[nodiscard]] bool has_capacity() const {
    return count() + ContactSet::kMostHeld <= ContactSet::kMostNumbers;
  }
  [[nodiscard]] int count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] const grasp::Contact& contact(int number) const { return contacts_[number]; }
  [[nodiscard]] grasp::Grasp GraspOf(const ContactSet& set) const;

  using GraspEvaluator::CanMeet;
  [[nodiscard]] bool CanMeet(int a, int b) const { return CanMeet(contacts_[a], contacts_[b]); }
  /// Whether a finger can come to `contact` while others hold `set`.
  [[nodiscard]] bool CanMeet(const ContactSet& set, int contact) const;

  /// Whether a sequence may pass this grasp: it is admitted.
  [[nodiscard]] bool Admits(const ContactSet& set) {
    if (set.size() < fewest_contacts()) return false;
    return GraspEvaluator::Admits(known_[set], [&] { return ContactsOf(set); });
  }
  [[nodiscard]] double RequiredHalfAngle(const ContactSet& set) {
    return GraspEvaluator::RequiredHalfAngle(known_[set], [&] { return ContactsOf(set); });
  }
  /// Takes a grasp as it is, whatever it is worth: the ends of a sequence.
  void Accept(const ContactSet& set) { known_[set] = KnownGrasp::Accepted(); }

 private:
  /// The contacts of a set, without asking for memory.
  struct HeldContacts : boost::container::static_vector<grasp::Contact, ContactSet::kMostHeld> {
    // Boost's iterators are not contiguous ones, so std::span does not take the container itself.
    operator std::span<const grasp::Contact>() const { return {data(), size()}; }  // NOLINT
  };
  [[nodiscard]] HeldContacts ContactsOf(const ContactSet& set) const;

  std::vector<grasp::Contact> contacts_;
  std::unordered_map<ContactSet, KnownGrasp, ContactSetHash> known_;
};

}  // namespace regrasp::criteria
