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

#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// Whether a search uses sliding steps in addition to finger switches.
enum class UseAligns { kNo, kYes };

/// Largest number of contacts of a subset search. Arrays with one element per subset have at most
/// 2¹⁶ elements.
inline constexpr int kMostSubsetContacts = 16;

/// Graph of the grasps of a few contacts and the steps between them.
/// A hand of h fingers can switch from A to B iff |A ∪ B| ≤ h. Sliding steps are assumed feasible
/// until a path that uses them is made. They are then proved, or refused from then on.
class SubsetGraph {
 public:
  /// Subset of the contacts as bits.
  using Mask = std::uint32_t;

  /// @param contacts  contacts of the grasps, ends included, at most kMostSubsetContacts. All
  ///     arguments outlive this object.
  SubsetGraph(const criteria::ContactSet& from, const criteria::ContactSet& to,
              const std::vector<int>& contacts, UseAligns aligns, SearchSpace& space);

  [[nodiscard]] Mask from() const { return ends_[0]; }
  [[nodiscard]] Mask to() const { return ends_[1]; }
  [[nodiscard]] int contact_count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] std::size_t mask_count() const { return std::size_t{1} << contacts_.size(); }
  [[nodiscard]] int contact(int i) const { return contacts_[i]; }
  [[nodiscard]] criteria::ContactSet SetOf(Mask mask) const;

  /// Return whether a sequence may contain a grasp; both ends are admitted without a test.
  [[nodiscard]] bool Admits(Mask mask) {
    return mask == ends_[0] || mask == ends_[1] || space_.Admits(SetOf(mask));
  }

  [[nodiscard]] bool IsSwitch(Mask a, Mask b) const {
    return Count(a | b) <= space_.fingers() && AreApart(a | b);
  }

  /// Visit all grasps one finger switch away, tested or not.
  /// @param matters  predicate that selects grasps.
  /// @param visit  callback for the selected grasps.
  template <typename Matters, typename Visit>
  void ForEachSwitch(Mask mask, const Matters& matters, const Visit& visit) const {
    Place(mask, mask, 0, space_.fingers() - Count(mask), [&](Mask next) {
      if (matters(next) && CanRest(next, false)) visit(next);
    });
  }

  /// Visit all grasps one sliding step away, with the total straight distance of all contacts.
  /// A grasp with several pairings is visited several times.
  /// @param matters, visit  predicate and callback, which also receive the distance.
  template <typename Matters, typename Visit>
  void ForEachAlign(Mask mask, const Matters& matters, const Visit& visit) {
    if (!aligns_) return;
    for (const Move& move : MovesFrom(mask)) {
      if (move.over > over_ || !matters(move.to, move.distance) || IsRefused(mask, move.to))
        continue;
      visit(move.to, move.distance);
    }
  }

  /// Return the distance between two contacts.
  [[nodiscard]] double Distance(int a, int b) const {
    return (space_.contact(contacts_[a]).p - space_.contact(contacts_[b]).p).norm();
  }

  /// Make the path over a sequence of grasps, and prove its sliding steps.
  /// @returns the path; nullopt if a sliding step is not proved. That step is then refused at the
  ///     space's friction angle and below. After some refusals there are no more sliding steps
  ///     across edges, after many none at all.
  [[nodiscard]] std::optional<GraspPath> MakePath(const std::vector<Mask>& masks);

 private:
  /// Compilers call a function for std::popcount if the target processor may lack the instruction.
  [[nodiscard]] static int Count(Mask mask) {
    int count = 0;
    for (; mask != 0; mask &= mask - 1) ++count;
    return count;
  }

  [[nodiscard]] Mask MaskOf(const criteria::ContactSet& set) const;

  /// Return whether a grasp of all fingers loses force closure without any one of them.
  /// A hand without a free finger can only switch to a subset of its contacts, and has no finger
  /// left to support sliding steps. Full grasps are therefore used only if there is no other path.
  [[nodiscard]] bool NeedsAll(const criteria::ContactSet& set) const;

  void FindTargets();

  /// Return whether there are enough contacts and, unless `may_be_full`, a free finger.
  [[nodiscard]] bool CanRest(Mask mask, bool may_be_full) const {
    if (mask == ends_[0] || mask == ends_[1]) return true;
    const int held = Count(mask);
    return held >= space_.fewest_contacts() && (held < space_.fingers() || may_be_full);
  }

  /// Visit all switches from `mask` that place `placed` and optionally more contacts from `first`
  /// on.
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

  /// Possible end of a contact's motion in a sliding step.
  struct Target {
    int contact;
    int edges;  ///< 1 if it is on another face
    double distance;
  };
  /// Sliding step that has not been proved.
  struct Move {
    Mask to;
    int over;  ///< number of contacts that move over an edge
    double distance;
  };
  /// Return all grasps with each contact unchanged, elsewhere on its face, or over an edge.
  /// Computed once, because searches revisit the same grasps at other friction angles.
  [[nodiscard]] const std::vector<Move>& MovesFrom(Mask mask);
  /// Add the moves of the contacts from `first` on, after others have been moved.
  void AddMoves(Mask mask, const Move& moved, int first, std::vector<Move>& moves) const;

  [[nodiscard]] bool AreApart(Mask mask) const {
    for (Mask rest = mask; rest != 0; rest &= rest - 1) {
      if ((apart_[std::countr_zero(rest)] & mask) != 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool IsRefused(Mask a, Mask b) const {
    const auto found = refused_.find({std::min(a, b), std::max(a, b)});
    return found != refused_.end() && space_.friction_angle() <= found->second;
  }

  SearchSpace& space_;
  const std::vector<int>& contacts_;
  bool aligns_;
  int over_;  ///< number of contacts that a sliding step may move to other faces
  int over_refusals_ = 0;
  /// Whether sliding steps may connect grasps of all fingers to others.
  bool may_stay_full_ = false;
  std::vector<Mask> apart_;  ///< contacts that it cannot be combined with [contact]
  std::vector<std::vector<Target>> targets_;  ///< possible ends [contact]
  std::unordered_map<Mask, std::vector<Move>> moves_;
  std::array<Mask, 2> ends_;
  /// Largest friction angle at which a sliding step was not proved.
  std::map<std::pair<Mask, Mask>, double> refused_;
};

/// Find a path over a few contacts with the fewest steps.
/// Breadth-first search from both ends over the steps of a SubsetGraph. A subset is tested when it
/// is first reached.
///
/// Laws: all grasps except the ends are admitted. The fewest steps never increase with more
/// contacts, more friction or sliding steps. (With sliding steps the path found is not always the
/// shortest, because those across edges are dropped after several failed proofs.)
/// @param contacts   contacts of the grasps, ends included, at most kMostSubsetContacts.
/// @param most_steps largest number of steps.
/// @returns the path; nullopt if there is none.
[[nodiscard]] std::optional<GraspPath> SearchSubsets(const criteria::ContactSet& from,
                                                     const criteria::ContactSet& to,
                                                     const std::vector<int>& contacts,
                                                     UseAligns aligns, int most_steps,
                                                     SearchSpace& space);

/// Find a path of at most `most_steps` steps that requires the least friction, to a milliradian.
/// Bisects the friction angle at which SearchSubsets finds a path. Results at one angle save tests
/// at other angles, so that all searches together take little more time than the first.
/// @param least  friction angle below which the search stops, radians.
/// @returns the path; nullopt if none requires less than the space's friction angle.
[[nodiscard]] std::optional<GraspPath> SearchWidest(const criteria::ContactSet& from,
                                                    const criteria::ContactSet& to,
                                                    const std::vector<int>& contacts,
                                                    UseAligns aligns, int most_steps, double least,
                                                    SearchSpace& space);

/// Find a path by finger switches over the contacts of the two grasps only.
/// With enough friction this connects nearly all pairs.
[[nodiscard]] std::optional<GraspPath> SearchOwnSubsets(const criteria::ContactSet& from,
                                                        const criteria::ContactSet& to,
                                                        SearchSpace& space);

}  // namespace regrasp::tree
