#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Twists that have separated some subset of contacts, for use on the others: a twist against which
/// every wrench of some contacts works refutes force closure of all subsets of these.
///
/// Of every twist a row of bits says which contacts it holds off; of every contact another row says
/// which twists hold it off. The pool is a ring: new twists take the place of the oldest.
class SeparatorPool {
 public:
  using Word = std::uint64_t;
  using Twist = WrenchSimplex<6>::Vector;

  /// @param contacts  with their rims set, in the frame of the twists; must outlive this object.
  explicit SeparatorPool(std::span<const UnitContact> contacts);

  void Add(const Twist& twist);

  /// Restricts what follows to subsets with these contacts.
  void FixPair(int a, int b);

  /// Those of some contacts that are left when some twist of the pool holds off any of them
  /// together with `third` and the pair.
  /// @param contacts  bits of the contacts' word of that number.
  [[nodiscard]] Word LeftOpen(int third, int word, Word contacts) const;
  /// The same for the twist alone that was added last.
  [[nodiscard]] Word LeftOpenByLast(int third, int word, Word contacts) const;

 private:
  static constexpr int kWordBits = 64;
  static constexpr int kPoolWords = 16;
  static constexpr int kTwists = kPoolWords * kWordBits;

  [[nodiscard]] bool Holds(int twist, int contact) const {
    return ((held_[static_cast<std::size_t>(twist) * words_ + contact / kWordBits] >>
             (contact % kWordBits)) &
            1U) != 0;
  }

  std::span<const UnitContact> contacts_;
  int words_;
  double column_size_ = 0;
  int last_ = -1;              ///< twist
  std::vector<Word> held_;     ///< by twist, words_ each: bit c
  std::vector<Word> holding_;  ///< by contact, kPoolWords each: bit t
  std::array<int, 2> pair_ = {-1, -1};
  std::array<Word, kPoolWords> holding_pair_{};  ///< twists that hold off the pair
};

}  // namespace regrasp::grasp
