#include "planner/tree/subset_graph.h"

#include <cassert>

namespace regrasp::tree {

namespace {

/// Optimistic aligns that turn out not to hold before a search does without any more of them, and
/// before it does without those across edges.
constexpr std::size_t kMostRefusals = 32;
constexpr int kMostOverRefusals = 8;

/// Contacts that an align takes to other faces, and for each contact so many to choose from, the
/// nearest ones.
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
        refused_[{std::min(before, masks[i]), std::max(before, masks[i])}] = space_.half_angle();
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

}  // namespace regrasp::tree
