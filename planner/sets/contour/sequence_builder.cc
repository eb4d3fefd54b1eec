#include "planner/sets/contour/sequence_builder.h"

#include <algorithm>
#include <numeric>

#include "planner/sets/contour/align_route.h"

namespace regrasp {

namespace {

/// A switch from the grasp at hand, or to the goal, is good enough with this share of the best
/// one's margin: it spares an align.
constexpr double kGoodShare = 0.5;

/// Half-widths of regions in plans are smaller than computed by this share of them, and by this one
/// of the boundary's length: rounding.
constexpr double kRegionRounding = 1e-9;
constexpr double kBoundaryRounding = 1e-11;

}  // namespace

ContourSequenceBuilder::ContourSequenceBuilder(SetGeometry& geometry,
                                               const GraspEvaluator& evaluator, SwitchObjective aim,
                                               const End& start, const End& goal)
    : geometry_(geometry), evaluator_(evaluator), aim_(aim), start_(start), goal_(goal) {}

CandidateSequence ContourSequenceBuilder::MakeEmpty() const {
  CandidateSequence draft;
  for (const Contact& contact : start_.grasp) {
    draft.initial.push_back({static_cast<int>(draft.initial.size()), contact});
  }
  draft.rests = {{start_.grasp, std::nullopt}};
  return draft;
}

std::optional<CandidateSequence> ContourSequenceBuilder::Make(const std::vector<int>& path,
                                                              std::set<VertexPair>& banned) {
  CandidateSequence draft = MakeEmpty();
  at_ = start_.at;
  for (const FingerContact& held : draft.initial) {
    const bool first = held.contact.face == geometry_.graph().pieces()[at_.piece].edges[0];
    fingers_[first ? 0 : 1] = held.finger;
  }
  std::vector<ContourSwitch> switches;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto found = ChooseMaxMarginSwitch(path[i], path[i + 1], i + 2 == path.size());
    if (!found) {
      banned.insert(Unordered(path[i], path[i + 1]));
      return std::nullopt;
    }
    switches.push_back(*found);
    at_ = found->after;
  }
  at_ = start_.at;
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const VertexPair edge = Unordered(path[i], path[i + 1]);
    if (aim_ == SwitchObjective::kRegion) Enlarge(path[i], path[i + 1], switches[i]);
    AlignTo(switches[i].before, edge, draft);
    SwitchTo(switches[i], edge, draft);
  }
  AlignTo(goal_.at, std::nullopt, draft);
  return draft;
}

/// Takes the switch with the largest regions whose grasps are good, where there is one with larger
/// regions than the one at hand.
void ContourSequenceBuilder::Enlarge(int from, int to, ContourSwitch& found) {
  const auto [known, is_new] = largest_.try_emplace({from, to});
  if (is_new) {
    known->second = FindLargestSwitch(
        geometry_, from, to, [this](const ContourSwitch& candidate) { return IsGood(candidate); });
  }
  const std::optional<ContourSwitch>& largest = known->second;
  if (!largest) return;
  const auto rank = [this](const ContourSwitch& s) { return std::pair(IsGood(s), RegionOf(s)); };
  if (rank(*largest) > rank(found)) found = *largest;
}

/// Well inside both sets; where that is not good, the best by its score.
const std::optional<ContourSwitch>& ContourSequenceBuilder::BestMaxMarginSwitch(
    int from, int to, const PlacedScore& margin) {
  const auto [known, is_new] = max_margin_.try_emplace({from, to});
  if (!is_new) return known->second;
  known->second = FindMaxMarginSwitch(geometry_, from, to, margin);
  if (known->second && !IsGood(*known->second)) {
    const PlacedScore score = [this](const PlacedGrasp& g) { return evaluator_.Score(GraspOf(g)); };
    known->second = FindMaxMarginSwitch(geometry_, from, to, score);
  }
  return known->second;
}

std::optional<ContourSwitch> ContourSequenceBuilder::ChooseMaxMarginSwitch(int from, int to,
                                                                           bool last) {
  const PlacedScore margin = [this](const PlacedGrasp& grasp) {
    return geometry_.AngleMarginOf(grasp);
  };
  const std::optional<ContourSwitch>& best = BestMaxMarginSwitch(from, to, margin);
  if (!best) return std::nullopt;
  const double least = kGoodShare * std::min(geometry_.AngleMarginOf(best->before),
                                             geometry_.AngleMarginOf(best->after));
  const auto serves = [&](const std::optional<ContourSwitch>& found, bool before, bool after) {
    return found && (!before || geometry_.AngleMarginOf(found->before) >= least) &&
           (!after || geometry_.AngleMarginOf(found->after) >= least) && IsGood(*found);
  };
  if (last) {
    const auto between = FindSwitchBetween(geometry_.graph(), at_, goal_.at);
    if (between) return between;
  }
  if (const auto found = FindSwitchFrom(geometry_, at_, to, margin); serves(found, false, true)) {
    return found;
  }
  if (last) {
    const auto found = FindSwitchTo(geometry_, from, goal_.at, margin);
    if (serves(found, true, false)) return found;
  }
  return best;
}

/// Half-width of the smaller contact region of its two grasps.
double ContourSequenceBuilder::RegionOf(const ContourSwitch& found) const {
  return std::min(geometry_.SizeAt(found.before), geometry_.SizeAt(found.after));
}

/// Of the grasps that the switch is free to choose.
bool ContourSequenceBuilder::IsGood(const ContourSwitch& found) const {
  const auto is_good = [&](const PlacedGrasp& grasp) {
    return grasp == at_ || grasp == goal_.at || evaluator_.IsGood(GraspOf(grasp));
  };
  return is_good(found.before) && is_good(found.after);
}

/// The contacts of a grasp; those of start and goal as they were given.
Grasp ContourSequenceBuilder::GraspOf(const PlacedGrasp& grasp) const {
  Grasp contacts = geometry_.GraspOf(grasp);
  const Boundary& boundary = geometry_.graph().boundary();
  for (int k = 0; k < 2; ++k) {
    for (const End* end : {&start_, &goal_}) {
      for (const Contact& given : end->grasp) {
        const bool same =
            given.face == contacts[k].face && boundary.PlaceOf(given) == grasp.places[k];
        if (same) contacts[k] = given;
      }
    }
  }
  return contacts;
}

FingerGrasp ContourSequenceBuilder::Held(const PlacedGrasp& grasp) const {
  const Grasp contacts = GraspOf(grasp);
  FingerGrasp held = {{fingers_[0], contacts[0]}, {fingers_[1], contacts[1]}};
  std::ranges::sort(held, {}, &FingerContact::finger);
  return held;
}

void ContourSequenceBuilder::AlignTo(const PlacedGrasp& to, std::optional<VertexPair> chosen_for,
                                     CandidateSequence& draft) {
  if (at_ == to) return;
  const ContourGraph& graph = geometry_.graph();
  Align align;
  for (const PlacedGrasp& next : FindAlignRoute(geometry_, at_, to)) {
    // Around a vertex the finger on the edge that both pieces have stays with it.
    const auto& before = graph.pieces()[at_.piece].edges;
    const auto& after = graph.pieces()[next.piece].edges;
    if (next.piece != at_.piece && (before[0] == after[1] || before[1] == after[0])) {
      std::swap(fingers_[0], fingers_[1]);
    }
    at_ = next;
    align.waypoints.push_back(Held(at_));
  }
  draft.steps.emplace_back(std::move(align));
  draft.rests.push_back({GraspOf(at_), chosen_for});
}

void ContourSequenceBuilder::SwitchTo(const ContourSwitch& found, VertexPair chosen_for,
                                      CandidateSequence& draft) {
  const ContourGraph& graph = geometry_.graph();
  const int stays_before = graph.pieces()[found.before.piece].edges[0] == found.edge ? 0 : 1;
  const int stays_after = graph.pieces()[found.after.piece].edges[0] == found.edge ? 0 : 1;
  // Of the three fingers the one that is free; their numbers sum to 3.
  const int free = kContourFingers - fingers_[0] - fingers_[1];
  FingerContact placed = {free, GraspOf(found.after)[1 - stays_after]};
  const double rounding = kBoundaryRounding * graph.boundary().perimeter(0);
  placed.region = std::max((1 - kRegionRounding) * RegionOf(found) - rounding, 0.0);
  draft.steps.emplace_back(Switch{{placed}, {fingers_[1 - stays_before]}});
  const int stays = fingers_[stays_before];
  fingers_[stays_after] = stays;
  fingers_[1 - stays_after] = free;
  at_ = found.after;
  draft.rests.push_back({GraspOf(at_), chosen_for});
}

}  // namespace regrasp
