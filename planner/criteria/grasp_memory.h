#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <boost/container_hash/hash.hpp>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/hand/hand.h"

namespace regrasp::criteria {

/// Set of contacts that a hand holds at the same time.
/// They are given by their numbers in a GraspMemory, in ascending order.
class ContactSet {
 public:
  static constexpr int kMostHeld = hand::kFingersInSpace;
  /// Exclusive upper bound of contact numbers.
  static constexpr int kMostNumbers = std::numeric_limits<std::int16_t>::max();

  ContactSet() = default;

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int operator[](int i) const { return numbers_[i]; }
  [[nodiscard]] const std::int16_t* begin() const { return numbers_.data(); }
  [[nodiscard]] const std::int16_t* end() const { return numbers_.data() + size_; }

  [[nodiscard]] bool Has(int contact) const { return std::find(begin(), end(), contact) != end(); }

  void Insert(int contact) {
    assert(size_ < kMostHeld && contact >= 0 && contact < kMostNumbers && !Has(contact));
    int place = size_++;
    for (; place > 0 && numbers_[place - 1] > contact; --place) {
      numbers_[place] = numbers_[place - 1];
    }
    numbers_[place] = static_cast<std::int16_t>(contact);
  }
  [[nodiscard]] ContactSet With(int contact) const {
    ContactSet set = *this;
    set.Insert(contact);
    return set;
  }
  [[nodiscard]] ContactSet Without(int contact) const {
    ContactSet set;
    for (const int held : *this) {
      if (held != contact) set.numbers_[set.size_++] = static_cast<std::int16_t>(held);
    }
    return set;
  }

  /// Return the number of contacts in either set.
  [[nodiscard]] static int CountUnion(const ContactSet& a, const ContactSet& b) {
    int common = 0;
    for (const int contact : a) common += b.Has(contact) ? 1 : 0;
    return a.size() + b.size() - common;
  }

  friend bool operator==(const ContactSet& a, const ContactSet& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::array<std::int16_t, kMostHeld> numbers_{};
  std::int8_t size_ = 0;
};

/// Hash of contact sets.
struct ContactSetHash {
  std::size_t operator()(const ContactSet& set) const {
    return boost::hash_range(set.begin(), set.end());
  }
};

/// Numbered contacts with cached evaluations of their sets.
/// Contacts must be reachable (GraspEvaluator) before they are added.
class GraspMemory : public GraspEvaluator {
 public:
  using GraspEvaluator::GraspEvaluator;

  /// Add a contact unless it is known.
  /// @param contact  contact with its face.
  /// @returns number of the contact.
  int Add(const grasp::Contact& contact);
  [[nodiscard]] ContactSet Add(const grasp::Grasp& grasp);
  /// Add contacts under consecutive numbers, even if they are known.
  /// @throws std::invalid_argument  if there would be more than ContactSet::kMostNumbers.
  void Append(std::span<const grasp::Contact> contacts);
  /// Return whether the contacts of another grasp can be added.
  [[nodiscard]] bool has_capacity() const {
    return count() + ContactSet::kMostHeld <= ContactSet::kMostNumbers;
  }
  [[nodiscard]] int count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] const grasp::Contact& contact(int number) const { return contacts_[number]; }
  [[nodiscard]] grasp::Grasp GraspOf(const ContactSet& set) const;

  using GraspEvaluator::CanMeet;
  [[nodiscard]] bool CanMeet(int a, int b) const { return CanMeet(contacts_[a], contacts_[b]); }
  /// Return whether a finger can be placed at `contact` while others hold `set`.
  [[nodiscard]] bool CanMeet(const ContactSet& set, int contact) const;

  /// Return whether a grasp is admitted, so that a sequence may contain it.
  [[nodiscard]] bool Admits(const ContactSet& set) {
    if (set.size() < fewest_contacts()) return false;
    return GraspEvaluator::Admits(known_[set], [&] { return ContactsOf(set); });
  }
  [[nodiscard]] double RequiredFrictionAngle(const ContactSet& set) {
    return GraspEvaluator::RequiredFrictionAngle(known_[set], [&] { return ContactsOf(set); });
  }
  /// Admit a grasp without a test, as for start and goal.
  void Accept(const ContactSet& set) { known_[set] = KnownGrasp::Accepted(); }

 private:
  /// Contacts of a set, without memory allocation.
  struct HeldContacts : boost::container::static_vector<grasp::Contact, ContactSet::kMostHeld> {
    // Boost's iterators are not contiguous, so std::span does not accept the container itself.
    operator std::span<const grasp::Contact>() const { return {data(), size()}; }  // NOLINT
  };
  [[nodiscard]] HeldContacts ContactsOf(const ContactSet& set) const;

  std::vector<grasp::Contact> contacts_;
  std::unordered_map<ContactSet, KnownGrasp, ContactSetHash> known_;
};

}  // namespace regrasp::criteria
