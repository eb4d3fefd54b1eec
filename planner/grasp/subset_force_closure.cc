#include "planner/grasp/subset_force_closure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

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

TurnTable::TurnTable(std::span<const UnitContact> contacts)
    : count_(static_cast<int>(contacts.size())),
      words_((count_ + kWordBits - 1) / kWordBits),
      by_contact_(Row(Pair(count_, 0))),
      by_line_(Row(Pair(count_, 0))),
      antipodal_(Row(count_)) {
  for (int a = 0; a < count_; ++a) {
    for (int b = a + 1; b < count_; ++b) {
      for (int c = 0; c < count_; ++c) {
        if (c == a || c == b) continue;
        Store(a, b, c, TurnAboutLine(contacts[a], contacts[b], contacts[c]));
      }
      if (IsAntipodal(contacts[a], contacts[b])) {
        Set(&antipodal_[Row(a)], b);
        Set(&antipodal_[Row(b)], a);
      }
    }
  }
}

void TurnTable::Store(int a, int b, int c, Turn turn) {
  if (turn == Turn::kUnclear) return;
  if (turn == Turn::kNone) {
    Store(a, b, c, Turn::kPositive);
    Store(a, b, c, Turn::kNegative);
    return;
  }
  const int kind = turn == Turn::kPositive ? 0 : turn == Turn::kNegative ? 1 : 2;
  Set(&by_contact_[Row(Pair(a, b) + kind)], c);
  Set(&by_contact_[Row(Pair(b, a) + kind)], c);
  Set(&by_line_[Row(Pair(a, c) + kind)], b);
  Set(&by_line_[Row(Pair(b, c) + kind)], a);
}

using Word = TurnTable::Word;

UnitContacts MakeRimmedContacts(std::span<const Contact> points, const object::WrenchFrame& frame,
                                double friction_angle) {
  UnitContacts units = MakeUnitContacts(points, frame);
  if (HasTorsion(units)) {
    throw std::invalid_argument("force-closure subsets: pair lines require hard contacts");
  }
  SetUnitForces(units, friction_angle);
  return units;
}

/// Convert the twist of transformed contacts to the original contacts: u = v + ω × (q − c) s.
SeparatorPool::Twist MovedBack(const SeparatorPool::Twist& twist, const Recentring& moved) {
  const Eigen::Map<const Eigen::Vector3d> omega(twist.data() + 3);
  const Eigen::Vector3d v =
      Eigen::Map<const Eigen::Vector3d>(twist.data()) - moved.scale * omega.cross(moved.centre);
  const Eigen::Vector3d w = moved.scale * omega;
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}

/// Enumerate subsets with three contacts fixed and the fourth as the bit of a word.
class SubsetSearch {
 public:
  /// @param deadline, tell  arguments that must outlive this object.
  SubsetSearch(std::span<const Contact> points, const object::WrenchFrame& frame,
               double friction_angle, const Deadline& deadline, const Tell& tell)
      : count_(static_cast<int>(points.size())),
        deadline_(deadline),
        tell_(tell),
        units_(MakeRimmedContacts(points, frame, friction_angle)),
        turns_(units_),
        separators_(units_),
        triples_(static_cast<std::size_t>(count_) * count_ * turns_.words()) {}

  std::vector<std::array<int, 4>> Run() {
    ForEachTriple("three", [this](int i, int j, int k) { StoreTriple(i, j, k); });
    ForEachTriple("four", [this](int i, int j, int k) { ExtendTriple(i, j, k); });
    return std::move(found_);
  }

  [[nodiscard]] const SubsetCounts& counts() const { return counts_; }

 private:
  template <typename Function>
  void ForEachTriple(const std::string& fingers, Function function) {
    CountedProgress progress(tell_,
                             "testing the grasps of " + fingers + " on pairs of " +
                                 std::to_string(count_) + " contact points",
                             std::int64_t{count_} * (count_ - 1) / 2);
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        deadline_.Check();
        progress.Add();
        separators_.FixPair(i, j);
        for (int k = j + 1; k < count_; ++k) function(i, j, k);
      }
    }
  }

  /// Decide with the simplex, and store the twist that proves kNo.
  [[nodiscard]] Decision Simplex(std::initializer_list<int> subset) {
    UnitContacts contacts;
    for (int index : subset) contacts.push_back(units_[index]);
    const Recentring moved = Recentre(contacts);
    SeparatorPool::Twist twist;
    const Decision decision = DecideOnly<6>(contacts, twist);
    if (decision == Decision::kNo) separators_.Add(MovedBack(twist, moved));
    return decision;
  }

  [[nodiscard]] Word* Triple(int a, int b) {
    return &triples_[(static_cast<std::size_t>(a) * count_ + b) * turns_.words()];
  }

  /// Store whether three contacts are force closure.
  /// This requires that each contact turns the object in both directions about the line of the
  /// other two.
  void StoreTriple(int i, int j, int k) {
    if (!TurnTable::Has(turns_.ByContact(i, j).both, k) ||
        !TurnTable::Has(turns_.ByContact(i, k).both, j) ||
        !TurnTable::Has(turns_.ByContact(j, k).both, i)) {
      return;
    }
    if (Simplex({i, j, k}) != Decision::kYes) return;
    for (const auto& [a, b, c] : {std::array{i, j, k}, {i, k, j}, {j, k, i}}) {
      TurnTable::Set(Triple(a, b), c);
      TurnTable::Set(Triple(b, a), c);
    }
  }

  void ExtendTriple(int i, int j, int k) {
    for (int word = (k + 1) / TurnTable::kWordBits; word < turns_.words(); ++word) {
      const Word range = Range(k, word);
      const Word open = range & ~SamePath(i, j, k, word);
      const Word pairs = open & BalancedPair(i, j, k, word);
      const Word triples = open & ~pairs & FromTriples(i, j, k, word);
      counts_.subsets += std::popcount(range);
      counts_.rejected_by_lines += std::popcount(range & ~open);
      counts_.accepted_by_pairs += std::popcount(pairs);
      counts_.accepted_by_triples += std::popcount(triples);
      const std::int64_t before = counts_.by_simplex;
      Collect(i, j, k, word, open, pairs | triples);
      counts_.rejected_by_twists +=
          std::popcount(open & ~pairs & ~triples) - (counts_.by_simplex - before);
    }
  }

  /// Return the bits of a word that are indices above k.
  [[nodiscard]] Word Range(int k, int word) const {
    const int first = std::max(k + 1 - word * TurnTable::kWordBits, 0);
    const int last = std::min(count_ - word * TurnTable::kWordBits, TurnTable::kWordBits);
    if (first >= last) return 0;
    const Word above = ~Word{0} << first;
    return last == TurnTable::kWordBits ? above : above & ((Word{1} << last) - 1);
  }

  /// Return the fourth contacts l that a line refutes.
  /// About the line of some pair of i, j, k, l the other two turn the object in the same direction.
  [[nodiscard]] Word SamePath(int i, int j, int k, int word) const {
    Word result = 0;
    for (const auto& [a, b, c] : {std::array{i, j, k}, {i, k, j}, {j, k, i}}) {
      const TurnTable::Rows line = turns_.ByContact(a, b);
      if (TurnTable::Has(line.positive, c)) result |= line.positive[word];
      if (TurnTable::Has(line.negative, c)) result |= line.negative[word];
      const TurnTable::Rows first = turns_.ByLine(c, a);
      const TurnTable::Rows second = turns_.ByLine(c, b);
      result |= first.positive[word] & second.positive[word];
      result |= first.negative[word] & second.negative[word];
    }
    return result;
  }

  /// Return the fourth contacts l that an antipodal pair accepts.
  /// Some pair of i, j, k, l is antipodal, and the other two turn the object in both directions
  /// about its line.
  [[nodiscard]] Word BalancedPair(int i, int j, int k, int word) const {
    Word result = 0;
    for (const auto& [a, b, c] : {std::array{i, j, k}, {i, k, j}, {j, k, i}}) {
      if (TurnTable::Has(turns_.Antipodal(a), b)) {
        const TurnTable::Rows line = turns_.ByContact(a, b);
        result |= line.both[word];
        if (TurnTable::Has(line.both, c)) result = ~Word{0};
        if (TurnTable::Has(line.positive, c)) result |= line.negative[word];
        if (TurnTable::Has(line.negative, c)) result |= line.positive[word];
      }
      const TurnTable::Rows first = turns_.ByLine(c, a);
      const TurnTable::Rows second = turns_.ByLine(c, b);
      result |= turns_.Antipodal(c)[word] & (first.both[word] | second.both[word] |
                                             (first.positive[word] & second.negative[word]) |
                                             (first.negative[word] & second.positive[word]));
    }
    return result;
  }

  /// Return the fourth contacts l with which three of i, j, k, l are force closure.
  [[nodiscard]] Word FromTriples(int i, int j, int k, int word) {
    if (TurnTable::Has(Triple(i, j), k)) return ~Word{0};
    return Triple(i, j)[word] | Triple(i, k)[word] | Triple(j, k)[word];
  }

  void Collect(int i, int j, int k, int word, Word open, Word accepted) {
    Word unsettled = separators_.LeftOpen(k, word, open & ~accepted);
    while (unsettled != 0) {
      const int bit = std::countr_zero(unsettled);
      unsettled &= unsettled - 1;
      ++counts_.by_simplex;
      const Decision decision = Simplex({i, j, k, word * TurnTable::kWordBits + bit});
      if (decision == Decision::kTooClose) ++counts_.too_close;
      if (decision == Decision::kYes) accepted |= Word{1} << bit;
      // The twist may hold off further contacts.
      if (decision == Decision::kNo) unsettled = separators_.LeftOpenByLast(k, word, unsettled);
    }
    for (; accepted != 0; accepted &= accepted - 1) {
      found_.push_back({i, j, k, word * TurnTable::kWordBits + std::countr_zero(accepted)});
    }
  }

  int count_;
  const Deadline& deadline_;
  const Tell& tell_;
  UnitContacts units_;
  TurnTable turns_;
  SeparatorPool separators_;
  std::vector<Word> triples_;  // bit c [row (a, b)]: a, b, c are force closure
  std::vector<std::array<int, 4>> found_;
  SubsetCounts counts_;
};

}  // namespace

std::vector<std::array<int, 4>> ForceClosureSubsets(std::span<const Contact> points,
                                                    const object::WrenchFrame& frame,
                                                    double friction_angle, SubsetCounts* counts,
                                                    const Deadline& deadline, const Tell& tell) {
  CheckGrasp(points, frame);
  CheckFrictionAngle(friction_angle);
  if (frame.dimension != 3)
    throw std::invalid_argument("force-closure subsets: the frame must have 3 dimensions");
  const object::WrenchFrame own = ContactFrame(points, frame.dimension);
  if (counts != nullptr) *counts = {};
  if (!(own.radius > 0)) return {};
  SubsetSearch search(points, own, friction_angle, deadline, tell);
  std::vector<std::array<int, 4>> found = search.Run();
  if (counts != nullptr) *counts = search.counts();
  return found;
}

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
