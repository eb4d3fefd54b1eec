#include "planner/sets/polygon/sequence_builder.h"

#include <algorithm>

#include "planner/planning/switch_sequence.h"
#include "planner/sets/polygon/align_path.h"

namespace regrasp {

using Eigen::VectorXd;

namespace {

/// A switch from the grasp at hand, or to the goal's, or one that keeps more contacts is good
/// enough with this share of the best one's score: it spares an align or a move.
constexpr double kGoodShare = 0.5;

/// Of the switches with at least half of the best score, the one that keeps the most contacts.
std::optional<SwitchPoint> BestOf(std::vector<SwitchPoint> points, const SwitchSide& from,
                                  const SwitchSide& to, const GraspScore& score) {
  std::vector<double> scores;
  for (const SwitchPoint& point : points) scores.push_back(ScoreOf(from, to, point, score));
  std::optional<std::size_t> best;
  const double highest = scores.empty() ? 0 : *std::max_element(scores.begin(), scores.end());
  const double least = highest > 0 ? kGoodShare * highest : highest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (scores[i] < least) continue;
    const auto rank = [&](std::size_t k) { return std::pair(points[k].kept.size(), scores[k]); };
    if (!best || rank(i) > rank(*best)) best = i;
  }
  if (!best) return std::nullopt;
  return std::move(points[*best]);
}

/// The fingers that hold during a switch: all before it and those placed.
std::size_t FingersDuring(const FingerGrasp& before, const Grasp& after) {
  const auto is_new = [&](const Contact& contact) {
    return std::none_of(before.begin(), before.end(), [&](const FingerContact& finger) {
      return finger.contact.p == contact.p && finger.contact.n == contact.n;
    });
  };
  return before.size() + std::count_if(after.begin(), after.end(), is_new);
}

}  // namespace

PolygonSequenceBuilder::PolygonSequenceBuilder(const Polygon& polygon, const PolygonGraph& graph,
                                               GraphCells& cells, const GraspEvaluator& evaluator,
                                               const Grasp& start, const Grasp& goal)
    : polygon_(polygon),
      graph_(graph),
      cells_(cells),
      evaluator_(evaluator),
      start_(start),
      goal_(goal),
      score_([this](const GraspSet& set, const VectorXd& parameters) {
        return evaluator_.Score(GraspAt(set, parameters));
      }) {}

CandidateSequence PolygonSequenceBuilder::MakeEmpty() const {
  CandidateSequence draft;
  for (const Contact& contact : start_) {
    draft.initial.push_back({static_cast<int>(draft.initial.size()), contact});
  }
  draft.rests = {{start_, std::nullopt}};
  return draft;
}

std::optional<CandidateSequence> PolygonSequenceBuilder::Make(const std::vector<int>& path,
                                                              const Attachment& from,
                                                              const Attachment& to,
                                                              std::set<VertexPair>& banned) {
  CandidateSequence draft = MakeEmpty();
  holding_ = held_before_ = draft.initial;
  SwitchTo(GraspAt(graph_.sets()[from.vertex], from.parameters), std::nullopt, draft);
  VectorXd at = from.parameters;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const VertexPair edge = Unordered(path[i], path[i + 1]);
    const bool last = i + 2 == path.size();
    const auto point = ChooseSwitch(path[i], path[i + 1], at, last ? &to : nullptr);
    if (!point || !AlignTo(path[i], at, point->before, edge, draft)) {
      banned.insert(edge);
      return std::nullopt;
    }
    SwitchTo(GraspAt(graph_.sets()[path[i + 1]], point->after), edge, draft);
    at = point->after;
  }
  if (!AlignTo(path.back(), at, to.parameters, std::nullopt, draft)) {
    if (path.size() > 1) banned.insert(Unordered(path[path.size() - 2], path.back()));
    return std::nullopt;
  }
  SwitchTo(goal_, std::nullopt, draft);
  return draft;
}

/// The switch between two sets: from the grasp at hand and to the goal's where that costs little,
/// otherwise the best there is.
std::optional<SwitchPoint> PolygonSequenceBuilder::ChooseSwitch(int from, int to,
                                                                const VectorXd& at,
                                                                const Attachment* goal) {
  SwitchSide a = {&graph_.sets()[from], &cells_.of(from), std::nullopt};
  SwitchSide b = {&graph_.sets()[to], &cells_.of(to), std::nullopt};
  auto [known, is_new] = best_switches_.try_emplace({from, to});
  if (is_new) {
    known->second = BestOf(FindSwitchPoints(a, b, kPolygonFingers), a, b, score_);
    if (known->second) known->second = ImproveSwitch(a, b, *known->second, score_);
  }
  const std::optional<SwitchPoint>& best = known->second;
  if (!best) return std::nullopt;
  const double best_score = ScoreOf(a, b, *best, score_);
  for (const auto& [fix_from, fix_to] : {std::pair(true, true), {true, false}, {false, true}}) {
    if (fix_to && goal == nullptr) continue;
    a.fixed = fix_from ? std::optional(at) : std::nullopt;
    b.fixed = fix_to ? std::optional(goal->parameters) : std::nullopt;
    auto point = BestOf(FindSwitchPoints(a, b, kPolygonFingers), a, b, score_);
    if (point && ScoreOf(a, b, *point, score_) >= std::max(kGoodShare * best_score, 0.0)) {
      return point;
    }
  }
  return best;
}

/// The contacts of a set at given parameters; those of start and goal as they were given.
Grasp PolygonSequenceBuilder::GraspAt(const GraspSet& set, const VectorXd& parameters) const {
  Grasp grasp;
  for (const int edge : set.edges) {
    const double u = parameters[static_cast<Eigen::Index>(grasp.size())];
    Contact contact = ContactAt(polygon_, edge, u);
    for (const Grasp* given : {&start_, &goal_}) {
      for (const Contact& other : *given) {
        if (other.face == edge && ParameterOf(polygon_, other) == u) contact = other;
      }
    }
    grasp.push_back(contact);
  }
  return grasp;
}

/// @returns false where no way is found inside the set.
bool PolygonSequenceBuilder::AlignTo(int vertex, const VectorXd& from, const VectorXd& to,
                                     std::optional<VertexPair> chosen_for,
                                     CandidateSequence& draft) {
  if (from == to) return true;
  const std::vector<VectorXd> path = FindAlignPath(cells_.of(vertex), from, to);
  if (path.empty()) return false;
  Align align;
  for (const VectorXd& parameters : path) {
    const Grasp contacts = GraspAt(graph_.sets()[vertex], parameters);
    FingerGrasp waypoint = holding_;
    for (FingerContact& finger : waypoint) {
      finger.contact = *std::find_if(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return c.face == finger.contact.face;
      });
    }
    align.waypoints.push_back(std::move(waypoint));
  }
  align.waypoints.front() = holding_;
  AddStep(std::move(align), chosen_for, draft);
  return true;
}

/// No step where the contacts are those that hold already.
void PolygonSequenceBuilder::SwitchTo(const Grasp& after, std::optional<VertexPair> chosen_for,
                                      CandidateSequence& draft) {
  const auto is_empty = [](const Switch& s) { return s.place.empty() && s.release.empty(); };
  Switch step = MakeSwitch(holding_, after, kPolygonFingers);
  if (is_empty(step)) return;
  if (!draft.steps.empty() && std::holds_alternative<Switch>(draft.steps.back()) &&
      FingersDuring(held_before_, after) <= kPolygonFingers) {
    Switch both = MakeSwitch(held_before_, after, kPolygonFingers);
    if (!is_empty(both)) {
      step = std::move(both);
      holding_ = held_before_;
      draft.steps.pop_back();
      draft.rests.pop_back();
    }
  }
  AddStep(std::move(step), chosen_for, draft);
}

void PolygonSequenceBuilder::AddStep(Step step, std::optional<VertexPair> chosen_for,
                                     CandidateSequence& draft) {
  held_before_ = holding_;
  holding_ = GraspAfter(holding_, step);
  draft.rests.push_back({regrasp::ContactsOf(holding_), chosen_for});
  draft.steps.push_back(std::move(step));
}

}  // namespace regrasp
