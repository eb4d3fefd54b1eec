#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Number of 4-subsets by method of decision. The first five sum to `subsets`.
struct SubsetCounts {
  std::int64_t rejected_by_lines = 0;    ///< PairLineVerdict::kNo
  std::int64_t accepted_by_pairs = 0;    ///< PairLineVerdict::kYes
  std::int64_t accepted_by_triples = 0;  ///< three of the four are force closure alone
  std::int64_t rejected_by_twists = 0;   ///< held off by the twist that refuted another subset
  std::int64_t by_simplex = 0;           ///< decided by a linear program
  std::int64_t subsets = 0;
  /// Part of by_simplex that is too close to call, not among the results.
  std::int64_t too_close = 0;
};

/// Enumerate all force-closure 4-subsets of contact points in space.
/// The subsets are those for which TestForceClosure decides kYes, but are found much faster.
///
/// The directions in which every contact turns the object about the line through every pair
/// (TurnAboutLine) are stored as bit rows. The pair lines thus decide up to 64 subsets in a few
/// word operations, and the simplex decides only the remainder.
///
/// @param counts  output if not null.
/// @param tell    callback for progress.
/// @returns ascending indices, in lexicographic order.
/// @throws std::invalid_argument  as TestForceClosure, for a frame in the plane, and for soft
///     fingers.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] std::vector<std::array<int, 4>> ForceClosureSubsets(
    std::span<const Contact> points, const object::WrenchFrame& frame, double friction_angle,
    SubsetCounts* counts = nullptr, const Deadline& deadline = {}, const Tell& tell = {});

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
