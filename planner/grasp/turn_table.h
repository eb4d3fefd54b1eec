#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/grasp/pair_line.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

/// Turning directions of all contacts about the lines through all pairs, as rows of bits.
///
/// Lines run from the smaller to the larger index. For each kind of turn (kPositive, kNegative,
/// kBoth) there are two rows of words per ordered pair. `ByContact(a, b)` has bit c if c turns in
/// that direction about line ab. `ByLine(a, b)` has bit c if b turns in that direction about line
/// ac.
class TurnTable {
 public:
  using Word = std::uint64_t;
  static constexpr int kWordBits = 64;

  explicit TurnTable(std::span<const UnitContact> contacts);

  [[nodiscard]] int words() const { return words_; }

  struct Rows {
    const Word* positive;
    const Word* negative;
    const Word* both;
  };
  [[nodiscard]] Rows ByContact(int a, int b) const { return RowsOf(by_contact_, a, b); }
  [[nodiscard]] Rows ByLine(int a, int b) const { return RowsOf(by_line_, a, b); }

  /// Row of bits; bit b is set if a and b are an antipodal pair.
  [[nodiscard]] const Word* Antipodal(int a) const { return &antipodal_[Row(a)]; }

  [[nodiscard]] static bool Has(const Word* row, int bit) {
    return (row[bit / kWordBits] >> (bit % kWordBits)) & 1U;
  }
  static void Set(Word* row, int bit) { row[bit / kWordBits] |= Word{1} << (bit % kWordBits); }

 private:
  static constexpr int kKinds = 3;

  [[nodiscard]] std::size_t Row(std::size_t row) const { return row * words_; }
  [[nodiscard]] std::size_t Pair(int a, int b) const {
    return static_cast<std::size_t>(kKinds) * (static_cast<std::size_t>(a) * count_ + b);
  }
  [[nodiscard]] Rows RowsOf(const std::vector<Word>& bits, int a, int b) const {
    const std::size_t row = Pair(a, b);
    return {&bits[Row(row)], &bits[Row(row + 1)], &bits[Row(row + 2)]};
  }
  void Store(int a, int b, int c, Turn turn);

  int count_;
  int words_;
  std::vector<Word> by_contact_;
  std::vector<Word> by_line_;
  std::vector<Word> antipodal_;
};

}  // namespace regrasp::grasp
