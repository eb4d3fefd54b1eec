#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Twists that separated some subset of contacts, to refute other subsets.
/// If every wrench of some contacts works against a twist, the twist refutes force closure of all
/// subsets of these contacts. It *holds off* these contacts.
///
/// For each twist, a row of bits marks the contacts that it holds off. For each contact, a row of
/// bits marks the twists that hold it off. The pool is a ring: new twists replace the oldest.
class SeparatorPool {
 public:
  using Word = std::uint64_t;
  using Twist = WrenchSimplex<6>::Vector;

  /// @param contacts  contacts with rims set, in the frame of the twists; must outlive this object.
  explicit SeparatorPool(std::span<const UnitContact> contacts);

  void Add(const Twist& twist);

  /// Restrict later queries to subsets with these contacts.
  void FixPair(int a, int b);

  /// Return the contacts that no twist of the pool holds off together with `third` and the pair.
  /// @param word  index of the word of contacts.
  /// @param contacts  bits of candidate contacts in that word.
  [[nodiscard]] Word LeftOpen(int third, int word, Word contacts) const;
  /// Return the same for the most recently added twist only.
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
  int last_ = -1;              ///< index of the most recent twist
  std::vector<Word> held_;     ///< bit c [twist], words_ words each
  std::vector<Word> holding_;  ///< bit t [contact], kPoolWords words each
  std::array<int, 2> pair_ = {-1, -1};
  std::array<Word, kPoolWords> holding_pair_{};  ///< twists that hold off the pair
};

}  // namespace regrasp::grasp
