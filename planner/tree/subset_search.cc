#include "planner/tree/subset_search.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace regrasp::tree {

namespace {

/// Numbers of failed proofs after which a search uses no sliding steps, and no sliding steps across
/// edges.
constexpr std::size_t kMostRefusals = 32;
constexpr int kMostOverRefusals = 8;

/// Largest number of contacts that a sliding step moves to other faces, and number of nearest
/// choices for each.
constexpr int kMostOver = 2;
constexpr int kOverChoices = 3;

}  // namespace

SubsetGraph::SubsetGraph(const criteria::ContactSet& from, const criteria::ContactSet& to,
                         const std::vector<int>& contacts, UseAligns aligns, SearchSpace& space)
    : space_(space),
      contacts_(contacts),
      aligns_(aligns == UseAligns::kYes),
      over_(kMostOver),
      apart_(contacts.size(), 0),
      ends_{MaskOf(from), MaskOf(to)} {
  assert(contact_count() <= kMostSubsetContacts);
  for (int a = 0; a < contact_count(); ++a) {
    for (int b = 0; b < a; ++b) {
      if (space.CanMeet(contacts_[a], contacts_[b])) continue;
      apart_[a] |= Mask{1} << b;
      apart_[b] |= Mask{1} << a;
    }
  }
  if (!aligns_) return;
  FindTargets();
  may_stay_full_ = NeedsAll(from) || NeedsAll(to);
}

bool SubsetGraph::NeedsAll(const criteria::ContactSet& set) const {
  return set.size() == space_.fingers() && std::none_of(set.begin(), set.end(), [&](int contact) {
           return space_.Admits(set.Without(contact));
         });
}

void SubsetGraph::FindTargets() {
  targets_.resize(contacts_.size());
  for (int i = 0; i < contact_count(); ++i) {
    const grasp::Contact& from = space_.contact(contacts_[i]);
    std::vector<std::pair<double, int>> over;
    for (int k = 0; k < contact_count(); ++k) {
      const grasp::Contact& to = space_.contact(contacts_[k]);
      if (k == i) continue;
      if (to.face == from.face) {
        targets_[i].push_back({k, 0, Distance(i, k)});
      } else if (MayHandOver(from, to, space_.object())) {
        over.emplace_back(Distance(i, k), k);
      }
    }
    std::sort(over.begin(), over.end());
    over.resize(std::min<std::size_t>(over.size(), kOverChoices));
    for (const auto& [distance, k] : over) targets_[i].push_back({k, 1, distance});
  }
}

SubsetGraph::Mask SubsetGraph::MaskOf(const criteria::ContactSet& set) const {
  Mask mask = 0;
  for (int i = 0; i < contact_count(); ++i) {
    if (set.Has(contacts_[i])) mask |= Mask{1} << i;
  }
  return mask;
}

criteria::ContactSet SubsetGraph::SetOf(Mask mask) const {
  criteria::ContactSet set;
  for (; mask != 0; mask &= mask - 1) set.Insert(contacts_[std::countr_zero(mask)]);
  return set;
}

const std::vector<SubsetGraph::Move>& SubsetGraph::MovesFrom(Mask mask) {
  const auto [entry, is_new] = moves_.try_emplace(mask);
  if (is_new) AddMoves(mask, {mask, 0, 0}, 0, entry->second);
  return entry->second;
}

void SubsetGraph::AddMoves(Mask mask, const Move& moved, int first,
                           std::vector<Move>& moves) const {
  const bool full = may_stay_full_ && Count(mask) == space_.fingers();
  if (moved.to != mask && CanRest(moved.to, full) && AreApart(moved.to)) moves.push_back(moved);
  for (int i = first; i < contact_count(); ++i) {
    if ((mask >> i & 1) == 0) continue;
    for (const Target& target : targets_[i]) {
      const Mask bit = Mask{1} << target.contact;
      if (((mask | moved.to) & bit) != 0 || moved.over + target.edges > over_) continue;
      const Mask to = (moved.to & ~(Mask{1} << i)) | bit;
      AddMoves(mask, {to, moved.over + target.edges, moved.distance + target.distance}, i + 1,
               moves);
    }
  }
}

std::optional<GraspPath> SubsetGraph::MakePath(const std::vector<Mask>& masks) {
  GraspPath path{SetOf(masks.front()), {}};
  for (std::size_t i = 1; i < masks.size(); ++i) {
    const Mask before = masks[i - 1];
    PathStep step{SetOf(masks[i]), std::nullopt};
    if (!IsSwitch(before, masks[i])) {
      step.align = AlignBetween(SetOf(before), step.to, space_);
      if (!step.align) {
        refused_[{std::min(before, masks[i]), std::max(before, masks[i])}] =
            space_.friction_angle();
        if (refused_.size() >= kMostRefusals) aligns_ = false;
        if (TupleOf(SetOf(before), space_) != TupleOf(step.to, space_)) ++over_refusals_;
        if (over_refusals_ >= kMostOverRefusals) over_ = 0;
        return std::nullopt;
      }
    }
    path.steps.push_back(std::move(step));
  }
  return path;
}

namespace {

/// Accuracy of the bisection of friction angles, radians.
constexpr double kEqualAngles = 1e-3;

using Mask = SubsetGraph::Mask;

/// Breadth-first search from both ends; each round expands the end with fewer grasps.
class SubsetSearch {
 public:
  SubsetSearch(SubsetGraph graph, int most_steps)
      : graph_(std::move(graph)), most_steps_(most_steps) {}

  /// Search at the current friction angle of the space.
  std::optional<GraspPath> Search() {
    while (const auto middle = Meet()) {
      if (auto path = graph_.MakePath(PathThrough(*middle))) return path;
    }
    return std::nullopt;
  }

 private:
  static constexpr Mask kUnseen = ~Mask{0};
  static constexpr Mask kNoGrasp = kUnseen - 1;

  /// Grasps reached from one end.
  struct Side {
    std::vector<Mask> parents;  ///< parent [mask], kUnseen or kNoGrasp
    std::vector<Mask> level;    ///< grasps reached in the last round
    std::vector<Mask> next;     ///< grasps reachable from those, not tested yet
  };

  /// Expand the sides until they meet.
  /// @returns a grasp that both sides have reached.
  std::optional<Mask> Meet() {
    for (int i = 0; i < 2; ++i) {
      const Mask end = i == 0 ? graph_.from() : graph_.to();
      sides_[i].parents.assign(graph_.mask_count(), kUnseen);
      sides_[i].parents[end] = end;
      sides_[i].level = {end};
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

  /// Find a grasp between the sides; tests only grasps that both can reach.
  std::optional<Mask> MeetBetween(Side& near, Side& far) {
    FindNext(far);
    for (const Mask mask : far.next) {
      if (IsReached(mask, near) && graph_.Admits(mask)) return mask;
    }
    return std::nullopt;
  }

  [[nodiscard]] static bool IsReached(Mask mask, const Side& side) {
    return side.parents[mask] != kUnseen && side.parents[mask] != kNoGrasp;
  }

  void Advance(Side& side) {
    side.level.clear();
    for (const Mask mask : side.next) {
      if (graph_.Admits(mask)) {
        side.level.push_back(mask);
      } else {
        side.parents[mask] = kNoGrasp;
      }
    }
  }

  void FindNext(Side& side) {
    side.next.clear();
    for (const Mask mask : side.level) {
      const auto is_new = [&](Mask next, double /*travel*/ = 0) {
        return side.parents[next] == kUnseen;
      };
      const auto reach = [&](Mask next, double /*travel*/ = 0) {
        side.parents[next] = mask;
        side.next.push_back(next);
      };
      graph_.ForEachSwitch(mask, is_new, reach);
      graph_.ForEachAlign(mask, is_new, reach);
    }
  }

  [[nodiscard]] std::vector<Mask> PathThrough(Mask middle) const {
    std::vector<Mask> masks = {middle};
    while (masks.back() != graph_.from()) masks.push_back(sides_[0].parents[masks.back()]);
    std::reverse(masks.begin(), masks.end());
    while (masks.back() != graph_.to()) masks.push_back(sides_[1].parents[masks.back()]);
    return masks;
  }

  SubsetGraph graph_;
  int most_steps_;
  std::array<Side, 2> sides_;
};

}  // namespace

std::optional<GraspPath> SearchSubsets(const criteria::ContactSet& from,
                                       const criteria::ContactSet& to,
                                       const std::vector<int>& contacts, UseAligns aligns,
                                       int most_steps, SearchSpace& space) {
  return SubsetSearch({from, to, contacts, aligns, space}, most_steps).Search();
}

std::optional<GraspPath> SearchWidest(const criteria::ContactSet& from,
                                      const criteria::ContactSet& to,
                                      const std::vector<int>& contacts, UseAligns aligns,
                                      int most_steps, double least, SearchSpace& space) {
  const double before = space.friction_angle();
  SubsetSearch search({from, to, contacts, aligns, space}, most_steps);
  std::optional<GraspPath> widest;
  double low = least;
  double high = before;
  // Usually the ends determine the result.
  for (double middle = low + kEqualAngles; middle < high; middle = (low + high) / 2) {
    space.SetFrictionAngle(middle);
    if (auto path = search.Search()) {
      widest = std::move(path);
      high = middle;
    } else {
      low = middle;
    }
    if (high - low <= kEqualAngles) break;
  }
  space.SetFrictionAngle(before);
  return widest;
}

std::optional<GraspPath> SearchOwnSubsets(const criteria::ContactSet& from,
                                          const criteria::ContactSet& to, SearchSpace& space) {
  std::vector<int> contacts(from.begin(), from.end());
  for (const int contact : to) {
    if (!from.Has(contact)) contacts.push_back(contact);
  }
  return SearchSubsets(from, to, contacts, UseAligns::kNo, std::numeric_limits<int>::max(), space);
}

}  // namespace regrasp::tree
