#include "planner/tree/subset_search.h"

#include <algorithm>
#include <array>
#include <limits>

namespace regrasp::tree {

namespace {

/// Half-angles that are closer than this count as equal when the least one is looked for, radians.
constexpr double kEqualAngles = 1e-3;

using Mask = SubsetGraph::Mask;

/// A breadth-first search from both ends, by turns from the one with fewer grasps at hand.
class SubsetSearch {
 public:
  SubsetSearch(SubsetGraph graph, int most_steps)
      : graph_(std::move(graph)), most_steps_(most_steps) {}

  /// At the half-angle that the space has now.
  std::optional<GraspPath> Search() {
    while (const auto middle = Meet()) {
      if (auto path = graph_.MakePath(PathThrough(*middle))) return path;
    }
    return std::nullopt;
  }

 private:
  static constexpr Mask kUnseen = ~Mask{0};
  static constexpr Mask kNoGrasp = kUnseen - 1;

  /// What was reached from one end.
  struct Side {
    std::vector<Mask> parents;  ///< by mask: where it was reached from, kUnseen or kNoGrasp
    std::vector<Mask> level;    ///< the grasps reached last
    std::vector<Mask> next;     ///< what can be reached from those, not tested yet
  };

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

  /// One grasp more between the sides: only what both can reach is tested.
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
  const double before = space.half_angle();
  SubsetSearch search({from, to, contacts, aligns, space}, most_steps);
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

std::optional<GraspPath> SearchOwnSubsets(const criteria::ContactSet& from,
                                          const criteria::ContactSet& to, SearchSpace& space) {
  std::vector<int> contacts(from.begin(), from.end());
  for (const int contact : to) {
    if (!from.Has(contact)) contacts.push_back(contact);
  }
  return SearchSubsets(from, to, contacts, UseAligns::kNo, std::numeric_limits<int>::max(), space);
}

}  // namespace regrasp::tree
