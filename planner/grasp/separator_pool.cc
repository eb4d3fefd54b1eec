#include "planner/grasp/separator_pool.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "planner/grasp/cone_support.h"

namespace regrasp::grasp {

namespace {

/// Speed at which a point recedes from the object, relative to |twist| · |wrench|, above which a
/// twist is certain to hold a contact off. Together with the distance from the cone's border
/// (kInsideCone) it ensures a relative error of velocities of 1e-9.
constexpr double kRecedes = 1e-6;
constexpr double kInsideCone = 1 - 1e-8;

/// Return whether all forces in the contact's cone work against a velocity u.
/// The condition axial n·u + tangential |u⊥| < 0 is squared, because a square root per contact
/// would dominate the cost.
bool HoldsOff(const UnitContact& contact, const Eigen::Vector3d& u, double least) {
  const double approach = contact.n.dot(u);
  const double tangential = contact.tangential * contact.tangential;
  const double rim = contact.axial * contact.axial + tangential;
  return approach < -least &&
         tangential * u.squaredNorm() < kInsideCone * rim * approach * approach;
}

}  // namespace

SeparatorPool::SeparatorPool(std::span<const UnitContact> contacts)
    : contacts_(contacts),
      words_(static_cast<int>(contacts.size() + kWordBits - 1) / kWordBits),
      held_(static_cast<std::size_t>(kTwists) * words_),
      holding_(kPoolWords * contacts.size()) {
  for (const UnitContact& contact : contacts) {
    column_size_ = std::max(
        column_size_, (contact.axial + contact.tangential) * (1 + contact.q.template lpNorm<1>()));
  }
}

void SeparatorPool::Add(const Twist& twist) {
  double size = 0;
  for (const double value : twist) size += std::abs(value);
  const double least = kRecedes * size * column_size_;
  last_ = (last_ + 1) % kTwists;
  const int word = last_ / kWordBits;
  const Word bit = Word{1} << (last_ % kWordBits);
  Word* row = &held_[static_cast<std::size_t>(last_) * words_];
  std::fill_n(row, words_, 0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    Word& holding = holding_[c * kPoolWords + word];
    if (HoldsOff(contacts_[c], Velocity<6>(contacts_[c], twist.data()), least)) {
      row[c / kWordBits] |= Word{1} << (c % kWordBits);
      holding |= bit;
    } else {
      holding &= ~bit;
    }
  }
  holding_pair_[word] &= ~bit;
  if (pair_[0] >= 0 && Holds(last_, pair_[0]) && Holds(last_, pair_[1])) {
    holding_pair_[word] |= bit;
  }
}

void SeparatorPool::FixPair(int a, int b) {
  pair_ = {a, b};
  for (int w = 0; w < kPoolWords; ++w) {
    holding_pair_[w] = holding_[static_cast<std::size_t>(a) * kPoolWords + w] &
                       holding_[static_cast<std::size_t>(b) * kPoolWords + w];
  }
}

SeparatorPool::Word SeparatorPool::LeftOpen(int third, int word, Word contacts) const {
  for (int w = 0; w < kPoolWords; ++w) {
    Word twists = holding_pair_[w] & holding_[static_cast<std::size_t>(third) * kPoolWords + w];
    for (; twists != 0; twists &= twists - 1) {
      const std::size_t twist = static_cast<std::size_t>(w) * kWordBits + std::countr_zero(twists);
      contacts &= ~held_[twist * words_ + word];
      if (contacts == 0) return 0;
    }
  }
  return contacts;
}

SeparatorPool::Word SeparatorPool::LeftOpenByLast(int third, int word, Word contacts) const {
  const bool holds = Holds(last_, pair_[0]) && Holds(last_, pair_[1]) && Holds(last_, third);
  return holds ? contacts & ~held_[static_cast<std::size_t>(last_) * words_ + word] : contacts;
}

}  // namespace regrasp::grasp
