#include "planner/general/path_plan.h"

#include <algorithm>

#include "planner/graph/sequence.h"

namespace regrasp {

namespace {

bool SameContact(const Contact& a, const Contact& b) {
  return a.face == b.face && a.p == b.p && a.n == b.n;
}

/// Where every finger is after an align.
FingerGrasp AfterAlign(const FingerGrasp& before, const FaceAlign& align,
                       const SearchSpace& space) {
  FingerGrasp after = before;
  for (FingerContact& held : after) {
    for (const auto& [from, to] : align.contacts) {
      if (!SameContact(held.contact, space.contact(from))) continue;
      held.contact = space.contact(to);
      break;
    }
  }
  return after;
}

void AddAlign(const FingerGrasp& before, const FingerGrasp& after, Draft& draft) {
  auto* last = draft.steps.empty() ? nullptr : std::get_if<Align>(&draft.steps.back());
  if (last != nullptr) {
    last->waypoints.push_back(after);
    draft.rests.back().grasp = ContactsOf(after);
    return;
  }
  draft.steps.emplace_back(Align{{before, after}});
  draft.rests.push_back({ContactsOf(after), std::nullopt});
}

/// Of each contact of `from` that is not in `to`: from there to the nearest one that is new.
double WayOfSwitch(const ContactSet& from, const ContactSet& to, const SearchSpace& space) {
  double way = 0;
  for (const int placed : to) {
    if (from.Has(placed)) continue;
    double nearest = -1;
    for (const int left : from) {
      if (to.Has(left)) continue;
      const double distance = (space.contact(left).p - space.contact(placed).p).norm();
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    way += std::max(nearest, 0.0);
  }
  return way;
}

}  // namespace

Draft MakeDraft(const GraspPath& path, const Grasp& start, const SearchSpace& space) {
  Draft draft;
  for (std::size_t i = 0; i < start.size(); ++i) {
    draft.initial.push_back({static_cast<int>(i), start[i]});
  }
  draft.rests.push_back({start, std::nullopt});
  FingerGrasp holding = draft.initial;
  for (const PathStep& step : path.steps) {
    if (step.align) {
      const FingerGrasp after = AfterAlign(holding, *step.align, space);
      AddAlign(holding, after, draft);
      holding = after;
      continue;
    }
    const Switch change = MakeSwitch(holding, space.GraspOf(step.to), space.fingers());
    holding = GraspAfter(holding, change);
    draft.steps.emplace_back(change);
    draft.rests.push_back({ContactsOf(holding), std::nullopt});
  }
  return draft;
}

double TravelOf(const GraspPath& path, const SearchSpace& space) {
  double way = 0;
  const ContactSet* before = &path.start;
  for (const PathStep& step : path.steps) {
    way += step.align ? WayBetween(*before, step.to, space) : WayOfSwitch(*before, step.to, space);
    before = &step.to;
  }
  return way;
}

}  // namespace regrasp
