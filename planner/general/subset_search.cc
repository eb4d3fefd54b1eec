#include "planner/general/subset_search.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "planner/grasp/subset_force_closure.h"

namespace regrasp {

namespace {

/// Some of the contacts, by bits.
using Mask = std::uint32_t;

/// From so many contacts on most subsets of four are going to be asked for.
constexpr int kMany = 10;

/// Optimistic aligns that turn out not to hold before the search does without any more of them.
constexpr int kMostRefusals = 32;

class SubsetSearch {
 public:
  SubsetSearch(const std::vector<int>& contacts, UseAligns aligns, int most_steps,
               SearchSpace& space)
      : space_(space),
        contacts_(contacts),
        count_(static_cast<int>(contacts.size())),
        aligns_(aligns == UseAligns::kYes),
        most_steps_(most_steps),
        apart_(contacts.size(), 0) {
    assert(count_ <= kMostSubsetContacts);
    for (int a = 0; a < count_; ++a) {
      for (int b = 0; b < a; ++b) {
        if (space.CanMeet(contacts_[a], contacts_[b])) continue;
        apart_[a] |= Mask{1} << b;
        apart_[b] |= Mask{1} << a;
      }
    }
  }

  std::optional<GraspPath> Search(const ContactSet& from, const ContactSet& to) {
    from_ = MaskOf(from);
    to_ = MaskOf(to);
    if (space_.dimension() == 3 && count_ >= kMany) TestQuadruples();
    for (int refusals = 0;; ++refusals) {
      if (refusals == kMostRefusals) aligns_ = false;
      if (!Flood()) return std::nullopt;
      if (auto path = MakePath()) return path;
    }
  }

 private:
  static constexpr Mask kUnseen = ~Mask{0};
  static constexpr Mask kNoGrasp = kUnseen - 1;

  [[nodiscard]] Mask MaskOf(const ContactSet& set) const {
    Mask mask = 0;
    for (int i = 0; i < count_; ++i) {
      if (set.Has(contacts_[i])) mask |= Mask{1} << i;
    }
    return mask;
  }

  [[nodiscard]] ContactSet SetOf(Mask mask) const {
    ContactSet set;
    for (; mask != 0; mask &= mask - 1) set.Insert(contacts_[std::countr_zero(mask)]);
    return set;
  }

  /// All subsets of four at once, which is far faster than one after the other.
  void TestQuadruples() {
    Grasp points;
    for (const int contact : contacts_) points.push_back(space_.contact(contact));
    SubsetCounts counts;
    const auto found =
        ForceClosureSubsets(points, space_.object().wrench_frame(), space_.half_angle(), &counts);
    space_.CountTests(counts.subsets);
    quadruples_.assign(std::size_t{1} << count_, 0);
    for (const auto& [a, b, c, d] : found) {
      quadruples_[Mask{1} << a | Mask{1} << b | Mask{1} << c | Mask{1} << d] = 1;
    }
  }

  [[nodiscard]] bool Admits(Mask mask) {
    const bool known = !quadruples_.empty() && std::popcount(mask) == 4;
    if (!known) return space_.Admits(SetOf(mask));
    if (quadruples_[mask] == 0) return false;
    return space_.demands().min_quality == 0 || space_.Admits(SetOf(mask));
  }

  /// Level by level from the start. @returns whether the goal was reached.
  bool Flood() {
    parents_.assign(std::size_t{1} << count_, kUnseen);
    parents_[from_] = from_;
    std::vector<Mask> level = {from_};
    for (int steps = 0; parents_[to_] == kUnseen; ++steps) {
      if (level.empty() || steps == most_steps_) return false;
      next_.clear();
      for (const Mask mask : level) {
        Place(mask, mask, 0, space_.fingers() - std::popcount(mask));
        if (aligns_) Align(mask, mask, 0);
      }
      level = next_;
    }
    return true;
  }

  /// All switches from `mask` that place `placed`, and more contacts from the `first` on.
  void Place(Mask mask, Mask placed, int first, int spare) {
    for (Mask kept = mask;; kept = (kept - 1) & mask) {
      Reach(kept | (placed & ~mask), mask);
      if (kept == 0) break;
    }
    for (int i = first; spare > 0 && i < count_; ++i) {
      const Mask bit = Mask{1} << i;
      if ((placed & bit) != 0 || (apart_[i] & placed) != 0) continue;
      Place(mask, placed | bit, i + 1, spare - 1);
    }
  }

  /// All grasps with each contact, from the `first` on, at itself or at another one of its face.
  void Align(Mask mask, Mask moved, int first) {
    if (moved != mask && parents_[moved] == kUnseen && AreApart(moved) &&
        !refused_.contains({mask, moved})) {
      Reach(moved, mask);
    }
    for (int i = first; i < count_; ++i) {
      if ((mask >> i & 1) == 0) continue;
      for (int k = 0; k < count_; ++k) {
        const bool taken = ((mask | moved) >> k & 1) != 0;
        if (taken || FaceOf(k) != FaceOf(i)) continue;
        Align(mask, (moved & ~(Mask{1} << i)) | Mask{1} << k, i + 1);
      }
    }
  }

  [[nodiscard]] int FaceOf(int i) const { return space_.contact(contacts_[i]).face; }

  [[nodiscard]] bool AreApart(Mask mask) const {
    for (Mask rest = mask; rest != 0; rest &= rest - 1) {
      if ((apart_[std::countr_zero(rest)] & mask) != 0) return false;
    }
    return true;
  }

  void Reach(Mask mask, Mask parent) {
    if (parents_[mask] != kUnseen) return;
    if (mask != to_) {
      const int held = std::popcount(mask);
      // A hand that is full switches to nothing but a part of what it holds, and its aligns have no
      // spare finger to be carried out with.
      if (held < space_.fewest_contacts() || held == space_.fingers()) return;
      if (!Admits(mask)) {
        parents_[mask] = kNoGrasp;
        return;
      }
    }
    parents_[mask] = parent;
    next_.push_back(mask);
  }

  [[nodiscard]] bool IsSwitch(Mask a, Mask b) const {
    return std::popcount(a | b) <= space_.fingers() && AreApart(a | b);
  }

  /// The way that was found, its aligns proved; nullopt where one is not, which is then refused.
  std::optional<GraspPath> MakePath() {
    std::vector<Mask> masks = {to_};
    while (masks.back() != from_) masks.push_back(parents_[masks.back()]);
    std::reverse(masks.begin(), masks.end());
    GraspPath path{SetOf(from_), {}};
    for (std::size_t i = 1; i < masks.size(); ++i) {
      PathStep step{SetOf(masks[i]), std::nullopt};
      if (!IsSwitch(masks[i - 1], masks[i])) {
        step.align = AlignStraight(SetOf(masks[i - 1]), step.to, space_);
        if (!step.align) {
          refused_.insert({masks[i - 1], masks[i]});
          return std::nullopt;
        }
      }
      path.steps.push_back(std::move(step));
    }
    return path;
  }

  SearchSpace& space_;
  const std::vector<int>& contacts_;
  int count_;
  bool aligns_;
  int most_steps_;
  std::vector<Mask> apart_;  ///< by contact: those that it can't meet
  Mask from_ = 0;
  Mask to_ = 0;
  std::vector<Mask> parents_;  ///< where a set was reached from
  std::vector<Mask> next_;
  std::vector<char> quadruples_;  ///< by mask: 1 for four contacts in force closure; or empty
  std::set<std::pair<Mask, Mask>> refused_;
};

}  // namespace

std::optional<GraspPath> SearchSubsets(const ContactSet& from, const ContactSet& to,
                                       const std::vector<int>& contacts, UseAligns aligns,
                                       int most_steps, SearchSpace& space) {
  return SubsetSearch(contacts, aligns, most_steps, space).Search(from, to);
}

std::optional<GraspPath> SearchOwnSubsets(const ContactSet& from, const ContactSet& to,
                                          SearchSpace& space) {
  std::vector<int> contacts(from.begin(), from.end());
  for (const int contact : to) {
    if (!from.Has(contact)) contacts.push_back(contact);
  }
  return SearchSubsets(from, to, contacts, UseAligns::kNo, std::numeric_limits<int>::max(), space);
}

}  // namespace regrasp
