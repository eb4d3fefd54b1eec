#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// Whether aligns are looked for beside finger switches.
enum class UseAligns { kNo, kYes };

/// What is known of every subset is kept in an array of 2¹⁶ numbers at most.
inline constexpr int kMostSubsetContacts = 16;

/// The grasps of a few contacts and the steps between them. A hand of h fingers switches from A to
/// B iff |A ∪ B| ≤ h; aligns are taken to hold until a path that uses them is made, where they are
/// proved, or refused from then on.
class SubsetGraph {
 public:
  /// Some of the contacts, by bits.
  using Mask = std::uint32_t;

  /// @param contacts  those of the ends included, at most kMostSubsetContacts. All outlive this.
  SubsetGraph(const criteria::ContactSet& from, const criteria::ContactSet& to,
              const std::vector<int>& contacts, UseAligns aligns, SearchSpace& space);

  [[nodiscard]] Mask from() const { return ends_[0]; }
  [[nodiscard]] Mask to() const { return ends_[1]; }
  [[nodiscard]] int contact_count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] std::size_t mask_count() const { return std::size_t{1} << contacts_.size(); }
  [[nodiscard]] int contact(int i) const { return contacts_[i]; }
  [[nodiscard]] criteria::ContactSet SetOf(Mask mask) const;

  /// Whether a sequence may pass it; the ends are taken as they are.
  [[nodiscard]] bool Admits(Mask mask) {
    return mask == ends_[0] || mask == ends_[1] || space_.Admits(SetOf(mask));
  }

  [[nodiscard]] bool IsSwitch(Mask a, Mask b) const {
    return Count(a | b) <= space_.fingers() && AreApart(a | b);
  }

  /// All that one switch leads to, tested or not.
  /// @param matters  asked first. @param visit  told those that matter.
  template <typename Matters, typename Visit>
  void ForEachSwitch(Mask mask, const Matters& matters, const Visit& visit) const {
    Place(mask, mask, 0, space_.fingers() - Count(mask), [&](Mask next) {
      if (matters(next) && CanRest(next, false)) visit(next);
    });
  }

  /// All that one align may lead to, with the straight distance of all contacts together; the same
  /// more than once where there are several pairings.
  /// @param matters, visit  also told the distance.
  template <typename Matters, typename Visit>
  void ForEachAlign(Mask mask, const Matters& matters, const Visit& visit) {
    if (!aligns_) return;
    for (const Move& move : MovesFrom(mask)) {
      if (move.over > over_ || !matters(move.to, move.distance) || IsRefused(mask, move.to))
        continue;
      visit(move.to, move.distance);
    }
  }

  /// Between two contacts.
  [[nodiscard]] double Distance(int a, int b) const {
    return (space_.contact(contacts_[a]).p - space_.contact(contacts_[b]).p).norm();
  }

  /// @returns nullopt where an align is not proved; it is then refused at the space's half-angle
  ///          and below. After some of those there are no more aligns across edges, after many none
  ///          at all.
  [[nodiscard]] std::optional<GraspPath> MakePath(const std::vector<Mask>& masks);

 private:
  /// Compilers call a function for std::popcount where the processor need not have it.
  [[nodiscard]] static int Count(Mask mask) {
    int count = 0;
    for (; mask != 0; mask &= mask - 1) ++count;
    return count;
  }

  [[nodiscard]] Mask MaskOf(const criteria::ContactSet& set) const;

  /// Whether a grasp of all fingers holds with no finger less. A hand that is full switches to
  /// nothing but a part of what it holds, and its aligns have no spare finger to be carried out
  /// with: full grasps are passed only where there is no other path.
  [[nodiscard]] bool NeedsAll(const criteria::ContactSet& set) const;

  void FindTargets();

  /// Enough contacts, and a finger to spare unless it `may_be_full`.
  [[nodiscard]] bool CanRest(Mask mask, bool may_be_full) const {
    if (mask == ends_[0] || mask == ends_[1]) return true;
    const int held = Count(mask);
    return held >= space_.fewest_contacts() && (held < space_.fingers() || may_be_full);
  }

  /// All switches from `mask` that place `placed`, and more contacts from the `first` on.
  template <typename Reach>
  void Place(Mask mask, Mask placed, int first, int spare, const Reach& reach) const {
    const Mask added = placed & ~mask;
    for (Mask kept = mask;; kept = (kept - 1) & mask) {
      reach(kept | added);
      if (kept == 0) break;
    }
    for (int i = first; spare > 0 && i < contact_count(); ++i) {
      const Mask bit = Mask{1} << i;
      if ((placed & bit) != 0 || (apart_[i] & placed) != 0) continue;
      Place(mask, placed | bit, i + 1, spare - 1, reach);
    }
  }

  /// Where an align may take a contact.
  struct Target {
    int contact;
    int edges;  ///< 1 where that is on another face
    double distance;
  };
  /// An align that has not been proved.
  struct Move {
    Mask to;
    int over;  ///< contacts that go over an edge
    double distance;
  };
  /// All grasps with each contact at itself or at another one of its face, or over an edge.
  /// Enumerated once: searches come back to the same grasps at other half-angles.
  [[nodiscard]] const std::vector<Move>& MovesFrom(Mask mask);
  /// The same with the contacts from the `first` on, others having been moved.
  void AddMoves(Mask mask, const Move& moved, int first, std::vector<Move>& moves) const;

  [[nodiscard]] bool AreApart(Mask mask) const {
    for (Mask rest = mask; rest != 0; rest &= rest - 1) {
      if ((apart_[std::countr_zero(rest)] & mask) != 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool IsRefused(Mask a, Mask b) const {
    const auto found = refused_.find({std::min(a, b), std::max(a, b)});
    return found != refused_.end() && space_.half_angle() <= found->second;
  }

  SearchSpace& space_;
  const std::vector<int>& contacts_;
  bool aligns_;
  int over_;  ///< contacts that an align may take to other faces
  int over_refusals_ = 0;
  bool may_stay_full_ = false;  ///< grasps of all fingers may be reached from others, by aligns
  std::vector<Mask> apart_;     ///< by contact: those that it can't meet
  std::vector<std::vector<Target>> targets_;  ///< by contact
  std::unordered_map<Mask, std::vector<Move>> moves_;
  std::array<Mask, 2> ends_;
  /// The largest half-angle at which an align was not proved.
  std::map<std::pair<Mask, Mask>, double> refused_;
};

/// Joins two grasps over grasps of a few contacts, with the fewest steps: a breadth-first search
/// from both ends, by steps of a SubsetGraph, in which a subset is tested when it is first reached.
///
/// Laws: none of the sets but the ends needs to be admitted; the fewest steps never grow with more
/// contacts, more friction or aligns. (With aligns a path found is not always the shortest: those
/// across edges are given up after some that are not proved.)
/// @param contacts   those of the ends included, at most kMostSubsetContacts.
/// @param most_steps the search ends there.
/// @returns nullopt where there is no path.
[[nodiscard]] std::optional<GraspPath> SearchSubsets(const criteria::ContactSet& from,
                                                     const criteria::ContactSet& to,
                                                     const std::vector<int>& contacts,
                                                     UseAligns aligns, int most_steps,
                                                     SearchSpace& space);

/// Of the paths of at most `most_steps` steps one that needs the least friction, to a milliradian:
/// the half-angle at which SearchSubsets finds one is bisected. What is known of a grasp or an
/// align at one angle spares tests at the others, so that all take little more than the first.
/// @param least  no path is looked for that needs less than this half-angle, radians.
/// @returns nullopt where none needs less than the space's half-angle.
[[nodiscard]] std::optional<GraspPath> SearchWidest(const criteria::ContactSet& from,
                                                    const criteria::ContactSet& to,
                                                    const std::vector<int>& contacts,
                                                    UseAligns aligns, int most_steps, double least,
                                                    SearchSpace& space);

/// Over the contacts of the two grasps alone, by switches. With enough friction that joins nearly
/// all pairs.
[[nodiscard]] std::optional<GraspPath> SearchOwnSubsets(const criteria::ContactSet& from,
                                                        const criteria::ContactSet& to,
                                                        SearchSpace& space);

}  // namespace regrasp::tree
