#pragma once

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>
#include <cassert>
#include <cstdint>
#include <limits>

#include "planner/hand/hand.h"

namespace regrasp::criteria {

/// The contacts that a hand holds at once, by their numbers in a GraspMemory, in ascending order.
class ContactSet {
 public:
  static constexpr int kMostHeld = hand::kFingersInSpace;
  /// Numbers are smaller.
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

  /// Contacts of either set.
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

/// For hash tables of contact sets.
struct ContactSetHash {
  std::size_t operator()(const ContactSet& set) const {
    return boost::hash_range(set.begin(), set.end());
  }
};

}  // namespace regrasp::criteria
