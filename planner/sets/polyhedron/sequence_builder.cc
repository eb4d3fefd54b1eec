#include "planner/sets/polyhedron/sequence_builder.h"

#include <algorithm>
#include <numeric>

namespace regrasp {

namespace {

/// A switch from the grasp at hand, or to the goal, is good enough with this share of the best
/// one's score: it spares an align.
constexpr double kGoodShare = 0.5;

const FocusGrasp* FindIn(const std::vector<FocusGrasp>& grasps, int cell) {
  const auto found = std::ranges::find(grasps, cell, &FocusGrasp::cell);
  return found == grasps.end() ? nullptr : &*found;
}

}  // namespace

PolyhedronSequenceBuilder::PolyhedronSequenceBuilder(FocusGeometry& geometry,
                                                     const GraspEvaluator& evaluator,
                                                     const End& start, const End& goal)
    : geometry_(geometry), evaluator_(evaluator), start_(start), goal_(goal) {}

CandidateSequence PolyhedronSequenceBuilder::MakeEmpty() const {
  CandidateSequence draft;
  for (const Contact& contact : start_.grasp) {
    draft.initial.push_back({static_cast<int>(draft.initial.size()), contact});
  }
  draft.rests = {{start_.grasp, std::nullopt}};
  return draft;
}

std::optional<CandidateSequence> PolyhedronSequenceBuilder::Make(const std::vector<int>& path,
                                                                 std::set<VertexPair>& banned) {
  CandidateSequence draft = MakeEmpty();
  at_ = *FindIn(start_.at, path.front());
  goal_at_ = FindIn(goal_.at, path.back());
  const std::array<int, 4>& faces = geometry_.graph().cells()[at_.cell].faces;
  for (const FingerContact& held : draft.initial) {
    const auto position = std::ranges::find(faces, held.contact.face) - faces.begin();
    fingers_[position] = held.finger;
  }
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const VertexPair edge = Unordered(path[i], path[i + 1]);
    const auto found = ChooseSwitch(path[i], path[i + 1], i + 2 == path.size());
    if (!found || !AlignTo(found->before, edge, draft)) {
      banned.insert(edge);
      return std::nullopt;
    }
    SwitchTo(*found, edge, draft);
  }
  if (!AlignTo(*goal_at_, std::nullopt, draft)) return std::nullopt;
  return draft;
}

std::optional<FocusSwitch> PolyhedronSequenceBuilder::ChooseSwitch(int from, int to, bool last) {
  if (last) {
    const auto between = geometry_.FindSwitchBetween(at_, *goal_at_);
    if (between) return between;
  }
  const auto [known, is_new] = best_switches_.try_emplace({from, to});
  if (is_new) {
    known->second.found = geometry_.FindSwitch(from, to);
    if (const auto& found = known->second.found) {
      known->second.score = std::min(ScoreOf(found->before), ScoreOf(found->after));
    }
  }
  const std::optional<FocusSwitch>& best = known->second.found;
  if (!best) return std::nullopt;
  const double least = std::max(kGoodShare * known->second.score, 0.0);
  const auto found = geometry_.FindSwitchFrom(at_, to);
  if (found && ScoreOf(found->after) >= least) return found;
  if (last) {
    const auto to_goal = geometry_.FindSwitchTo(from, *goal_at_);
    if (to_goal && ScoreOf(to_goal->before) >= least) return to_goal;
  }
  return best;
}

double PolyhedronSequenceBuilder::ScoreOf(const FocusGrasp& grasp) const {
  return evaluator_.Score(geometry_.GraspOf(grasp));
}

FingerGrasp PolyhedronSequenceBuilder::Held(const FocusGrasp& grasp) const {
  FingerGrasp held;
  for (const Contact& contact : geometry_.GraspOf(grasp)) {
    held.push_back({fingers_[held.size()], contact});
  }
  std::ranges::sort(held, {}, &FingerContact::finger);
  return held;
}

/// @returns false where no way is found inside the cell.
bool PolyhedronSequenceBuilder::AlignTo(const FocusGrasp& to, std::optional<VertexPair> chosen_for,
                                        CandidateSequence& draft) {
  if (at_.points == to.points) {
    at_ = to;
    return true;
  }
  const std::vector<FocusGrasp> route = geometry_.FindRoute(at_, to);
  if (route.empty()) return false;
  Align align;
  for (const FocusGrasp& grasp : route) align.waypoints.push_back(Held(grasp));
  at_ = to;
  draft.steps.emplace_back(std::move(align));
  draft.rests.push_back({geometry_.GraspOf(at_), chosen_for});
  return true;
}

void PolyhedronSequenceBuilder::SwitchTo(const FocusSwitch& found, VertexPair chosen_for,
                                         CandidateSequence& draft) {
  const std::array<int, 4>& before = geometry_.graph().cells()[found.before.cell].faces;
  const std::array<int, 4>& after = geometry_.graph().cells()[found.after.cell].faces;
  // The fingers' numbers sum to 10 with the one that is free.
  const int all = kPolyhedronFingers * (kPolyhedronFingers - 1) / 2;
  const int free = all - std::accumulate(fingers_.begin(), fingers_.end(), 0);
  const Grasp contacts = geometry_.GraspOf(found.after);
  std::array<int, 4> fingers;
  Switch step;
  for (std::size_t k = 0; k < after.size(); ++k) {
    const auto position = std::ranges::find(before, after[k]) - before.begin();
    fingers[k] = position < 4 ? fingers_[position] : free;
    if (position == 4) step.place = {{free, contacts[k]}};
  }
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (std::ranges::find(after, before[k]) == after.end()) step.release = {fingers_[k]};
  }
  fingers_ = fingers;
  at_ = found.after;
  draft.steps.emplace_back(std::move(step));
  draft.rests.push_back({contacts, chosen_for});
}

}  // namespace regrasp
