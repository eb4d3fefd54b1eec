#include "planner/tree/path_plan.h"

#include <algorithm>
#include <cassert>

#include "planner/planning/switch_sequence.h"

namespace regrasp::tree {

namespace {

bool SameContact(const grasp::Contact& a, const grasp::Contact& b) {
  return a.face == b.face && a.p == b.p && a.n == b.n;
}

/// The waypoints of an align, each finger with its own contacts.
std::vector<plan::FingerGrasp> WaypointsFor(const plan::FingerGrasp& holding,
                                            const FaceAlign& align, const SearchSpace& space) {
  const std::vector<grasp::Grasp> grasps = WaypointsOf(align, space);
  std::vector<plan::FingerGrasp> waypoints(grasps.size(), holding);
  for (std::size_t f = 0; f < holding.size(); ++f) {
    const auto same = std::find_if(
        grasps.front().begin(), grasps.front().end(),
        [&](const grasp::Contact& contact) { return SameContact(holding[f].contact, contact); });
    assert(same != grasps.front().end());
    const auto place = same - grasps.front().begin();
    for (std::size_t w = 0; w < grasps.size(); ++w) waypoints[w][f].contact = grasps[w][place];
  }
  return waypoints;
}

void AddAlign(const std::vector<plan::FingerGrasp>& waypoints,
              planning::CandidateSequence& candidate) {
  auto* last =
      candidate.steps.empty() ? nullptr : std::get_if<plan::Align>(&candidate.steps.back());
  const grasp::Grasp after = plan::ContactsOf(waypoints.back());
  if (last != nullptr) {
    last->waypoints.insert(last->waypoints.end(), waypoints.begin() + 1, waypoints.end());
    candidate.rests.back().grasp = after;
    return;
  }
  candidate.steps.emplace_back(plan::Align{waypoints});
  candidate.rests.push_back({after, std::nullopt});
}

/// Of each contact of `from` that is not in `to`: from there to the nearest one that is new.
double TravelOfSwitch(const criteria::ContactSet& from, const criteria::ContactSet& to,
                      const SearchSpace& space) {
  double travel = 0;
  for (const int placed : to) {
    if (from.Has(placed)) continue;
    double nearest = -1;
    for (const int left : from) {
      if (to.Has(left)) continue;
      const double distance = (space.contact(left).p - space.contact(placed).p).norm();
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    travel += std::max(nearest, 0.0);
  }
  return travel;
}

}  // namespace

planning::CandidateSequence MakeCandidate(const GraspPath& path, const grasp::Grasp& start,
                                          const SearchSpace& space) {
  planning::CandidateSequence candidate = planning::StartOf(start);
  plan::FingerGrasp holding = candidate.initial;
  for (const PathStep& step : path.steps) {
    if (step.align) {
      const std::vector<plan::FingerGrasp> waypoints = WaypointsFor(holding, *step.align, space);
      AddAlign(waypoints, candidate);
      holding = waypoints.back();
      continue;
    }
    const plan::Switch change =
        planning::MakeSwitch(holding, space.GraspOf(step.to), space.fingers());
    holding = plan::GraspAfter(holding, change);
    candidate.steps.emplace_back(change);
    candidate.rests.push_back({plan::ContactsOf(holding), std::nullopt});
  }
  return candidate;
}

double TravelOf(const GraspPath& path, const SearchSpace& space) {
  double travel = 0;
  const criteria::ContactSet* before = &path.start;
  for (const PathStep& step : path.steps) {
    travel += step.align ? TravelOf(*step.align, space) : TravelOfSwitch(*before, step.to, space);
    before = &step.to;
  }
  return travel;
}

}  // namespace regrasp::tree
