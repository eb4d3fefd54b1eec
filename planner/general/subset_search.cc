#include "planner/general/subset_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>

namespace regrasp {

namespace {

/// Some of the contacts, by bits.
using Mask = std::uint32_t;

/// Optimistic aligns that turn out not to hold before the search does without any more of them, and
/// before it does without those across edges.
constexpr int kMostRefusals = 32;
constexpr int kMostOverRefusals = 8;

/// Contacts that an align takes to other faces, and for each contact so many to choose from, the
/// nearest ones.
constexpr int kMostOver = 2;
constexpr int kOverChoices = 3;

/// Half-angles that are closer than this count as equal when the least one is looked for, radians.
constexpr double kEqualAngles = 1e-3;

/// How many bits are set; compilers call a function for std::popcount where the processor need not
/// have an instruction for it.
int Count(Mask mask) {
  int count = 0;
  for (; mask != 0; mask &= mask - 1) ++count;
  return count;
}

/// A breadth-first search from both ends, by turns from the one with fewer grasps at hand.
class SubsetSearch {
 public:
  SubsetSearch(const ContactSet& from, const ContactSet& to, const std::vector<int>& contacts,
               UseAligns aligns, int most_steps, SearchSpace& space)
      : space_(space),
        contacts_(contacts),
        count_(static_cast<int>(contacts.size())),
        aligns_(aligns == UseAligns::kYes),
        most_steps_(most_steps),
        apart_(contacts.size(), 0),
        ends_{MaskOf(from), MaskOf(to)} {
    assert(count_ <= kMostSubsetContacts);
    for (int a = 0; a < count_; ++a) {
      for (int b = 0; b < a; ++b) {
        if (space.CanMeet(contacts_[a], contacts_[b])) continue;
        apart_[a] |= Mask{1} << b;
        apart_[b] |= Mask{1} << a;
      }
    }
    if (!aligns_) return;
    FindTargets();
    for (int i = 0; i < 2; ++i) sides_[i].may_stay_full = NeedsAll(i == 0 ? from : to);
  }

  /// At the half-angle that the space has now.
  std::optional<GraspPath> Search() {
    for (int refusals = 0;; ++refusals) {
      if (refusals == kMostRefusals) aligns_ = false;
      if (over_refusals_ == kMostOverRefusals) over_ = 0;
      const auto middle = Meet();
      if (!middle) return std::nullopt;
      if (auto path = MakePath(*middle)) return path;
    }
  }

 private:
  static constexpr Mask kUnseen = ~Mask{0};
  static constexpr Mask kNoGrasp = kUnseen - 1;

  /// What was reached from one end.
  struct Side {
    std::vector<Mask> parents;   ///< by mask: where it was reached from, kUnseen or kNoGrasp
    std::vector<Mask> level;     ///< the grasps reached last
    std::vector<Mask> next;      ///< what can be reached from those, not tested yet
    bool may_stay_full = false;  ///< grasps of all fingers may be reached, by aligns
  };

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

  /// @returns a grasp that both sides have reached.
  std::optional<Mask> Meet() {
    for (int i = 0; i < 2; ++i) {
      sides_[i].parents.assign(std::size_t{1} << count_, kUnseen);
      sides_[i].parents[ends_[i]] = ends_[i];
      sides_[i].level = {ends_[i]};
    }
    for (int steps = 1;; ++steps) {
      Side& near = sides_[sides_[1].level.size() < sides_[0].level.size() ? 1 : 0];
      Side& far = &near == &sides_[0] ? sides_[1] : sides_[0];
      FindNext(near);
      for (const Mask mask : near.next) {
        if (IsReached(mask, far)) return mask;
      }
      if (steps == most_steps_) break;
      if (steps + 1 == most_steps_) return MeetBetween(near, far);
      Advance(near);
      if (near.level.empty()) break;
    }
    return std::nullopt;
  }

  /// One grasp more between the sides: only what both can reach is tested.
  std::optional<Mask> MeetBetween(Side& near, Side& far) {
    FindNext(far);
    for (const Mask mask : far.next) {
      if (IsReached(mask, near) && space_.Admits(SetOf(mask))) return mask;
    }
    return std::nullopt;
  }

  [[nodiscard]] static bool IsReached(Mask mask, const Side& side) {
    return side.parents[mask] != kUnseen && side.parents[mask] != kNoGrasp;
  }

  void Advance(Side& side) {
    side.level.clear();
    for (const Mask mask : side.next) {
      if (space_.Admits(SetOf(mask))) {
        side.level.push_back(mask);
      } else {
        side.parents[mask] = kNoGrasp;
      }
    }
  }

  void FindNext(Side& side) {
    side.next.clear();
    for (const Mask mask : side.level) {
      Place(mask, mask, 0, space_.fingers() - Count(mask), side);
      if (aligns_) Align(mask, mask, 0, over_, side);
    }
  }

  /// All switches from `mask` that place `placed`, and more contacts from the `first` on.
  void Place(Mask mask, Mask placed, int first, int spare, Side& side) {
    const Mask added = placed & ~mask;
    for (Mask kept = mask;; kept = (kept - 1) & mask) {
      Reach(kept | added, mask, side);
      if (kept == 0) break;
    }
    for (int i = first; spare > 0 && i < count_; ++i) {
      const Mask bit = Mask{1} << i;
      if ((placed & bit) != 0 || (apart_[i] & placed) != 0) continue;
      Place(mask, placed | bit, i + 1, spare - 1, side);
    }
  }

  /// Whether a grasp of all fingers holds with no finger less. A hand that is full switches to
  /// nothing but a part of what it holds, and its aligns have no spare finger to be carried out
  /// with: full grasps are passed only where there is no other way.
  [[nodiscard]] bool NeedsAll(const ContactSet& set) {
    return set.size() == space_.fingers() && std::none_of(set.begin(), set.end(), [&](int contact) {
             return space_.Admits(set.Without(contact));
           });
  }

  void FindTargets() {
    targets_.resize(count_);
    for (int i = 0; i < count_; ++i) {
      const Contact& from = space_.contact(contacts_[i]);
      std::vector<std::pair<double, int>> over;
      for (int k = 0; k < count_; ++k) {
        const Contact& to = space_.contact(contacts_[k]);
        if (k == i) continue;
        if (to.face == from.face) {
          targets_[i].push_back({k, 0});
        } else if (MayGoOver(from, to, space_.object())) {
          over.emplace_back((from.p - to.p).norm(), k);
        }
      }
      std::sort(over.begin(), over.end());
      over.resize(std::min<std::size_t>(over.size(), kOverChoices));
      for (const auto& [way, k] : over) targets_[i].push_back({k, 1});
    }
  }

  /// All grasps with each contact, from the `first` on, at itself or at another one of its face, or
  /// with so many of them over an edge.
  void Align(Mask mask, Mask moved, int first, int over, Side& side) {
    if (moved != mask && side.parents[moved] == kUnseen && AreApart(moved) &&
        !IsRefused(mask, moved)) {
      Reach(moved, mask, side);
    }
    for (int i = first; i < count_; ++i) {
      if ((mask >> i & 1) == 0) continue;
      for (const auto& [k, edges] : targets_[i]) {
        if (((mask | moved) >> k & 1) != 0 || edges > over) continue;
        Align(mask, (moved & ~(Mask{1} << i)) | Mask{1} << k, i + 1, over - edges, side);
      }
    }
  }

  [[nodiscard]] bool AreApart(Mask mask) const {
    for (Mask rest = mask; rest != 0; rest &= rest - 1) {
      if ((apart_[std::countr_zero(rest)] & mask) != 0) return false;
    }
    return true;
  }

  void Reach(Mask mask, Mask parent, Side& side) {
    if (side.parents[mask] != kUnseen) return;
    if (mask != ends_[0] && mask != ends_[1]) {
      const int held = Count(mask);
      if (held < space_.fewest_contacts()) return;
      if (held == space_.fingers() && !(side.may_stay_full && Count(parent) == held)) return;
    }
    side.parents[mask] = parent;
    side.next.push_back(mask);
  }

  [[nodiscard]] bool IsSwitch(Mask a, Mask b) const {
    return Count(a | b) <= space_.fingers() && AreApart(a | b);
  }

  [[nodiscard]] bool IsRefused(Mask a, Mask b) const {
    const auto found = refused_.find({std::min(a, b), std::max(a, b)});
    return found != refused_.end() && space_.half_angle() <= found->second;
  }

  /// The way through `middle`, its aligns proved; nullopt where one is not, which is then refused.
  std::optional<GraspPath> MakePath(Mask middle) {
    std::vector<Mask> masks = {middle};
    while (masks.back() != ends_[0]) masks.push_back(sides_[0].parents[masks.back()]);
    std::reverse(masks.begin(), masks.end());
    while (masks.back() != ends_[1]) masks.push_back(sides_[1].parents[masks.back()]);
    GraspPath path{SetOf(ends_[0]), {}};
    for (std::size_t i = 1; i < masks.size(); ++i) {
      const Mask before = masks[i - 1];
      PathStep step{SetOf(masks[i]), std::nullopt};
      if (!IsSwitch(before, masks[i])) {
        step.align = AlignBetween(SetOf(before), step.to, space_);
        if (!step.align) {
          refused_[{std::min(before, masks[i]), std::max(before, masks[i])}] = space_.half_angle();
          if (TupleOf(SetOf(before), space_) != TupleOf(step.to, space_)) ++over_refusals_;
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
  int over_ = kMostOver;
  int over_refusals_ = 0;
  int most_steps_;
  std::vector<Mask> apart_;  ///< by contact: those that it can't meet
  /// By contact: where an align may take it, and whether to another face.
  std::vector<std::vector<std::pair<int, int>>> targets_;
  std::array<Mask, 2> ends_;
  std::array<Side, 2> sides_;
  /// The largest half-angle at which an align was not proved.
  std::map<std::pair<Mask, Mask>, double> refused_;
};

}  // namespace

std::optional<GraspPath> SearchSubsets(const ContactSet& from, const ContactSet& to,
                                       const std::vector<int>& contacts, UseAligns aligns,
                                       int most_steps, SearchSpace& space) {
  return SubsetSearch(from, to, contacts, aligns, most_steps, space).Search();
}

std::optional<GraspPath> SearchWidest(const ContactSet& from, const ContactSet& to,
                                      const std::vector<int>& contacts, UseAligns aligns,
                                      int most_steps, double least, SearchSpace& space) {
  const double before = space.half_angle();
  SubsetSearch search(from, to, contacts, aligns, most_steps, space);
  std::optional<GraspPath> widest;
  double low = least;
  double high = before;
  // Most often the ends are the limit.
  for (double middle = low + kEqualAngles; middle < high; middle = (low + high) / 2) {
    space.SetHalfAngle(middle);
    if (auto path = search.Search()) {
      widest = std::move(path);
      high = middle;
    } else {
      low = middle;
    }
    if (high - low <= kEqualAngles) break;
  }
  space.SetHalfAngle(before);
  return widest;
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
