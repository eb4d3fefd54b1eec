#include "planner/planning/plan_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "planner/base/number.h"
#include "planner/plan/plan_reach.h"
#include "planner/planning/rest_summary.h"
#include "planner/search/shortest_paths.h"

namespace regrasp {

namespace {

/// Grasps drawn from one set, and sets looked at, before a random grasp is given up.
constexpr int kDrawsPerSet = 30;
constexpr std::size_t kMaxSetDraws = 2000;

/// Paths tried for one whose grasps are all of the quality that is asked for.
constexpr int kMaxPaths = 600;

/// A graph that knows how far it is to its ends on the shortest ways: a search over sequences with
/// the fewest switches looks at nothing beside them.
class OnShortestPaths final : public SwitchingGraph {
 public:
  /// Both must outlive this object.
  OnShortestPaths(const SwitchingGraph& graph, const ShortestPaths& ways, int goal)
      : graph_(graph), paths_(ways), goal_(goal) {}

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count(); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    graph_.GetNeighbours(vertex, neighbours);
  }
  /// @param to  start or goal.
  [[nodiscard]] int MinSwitches(int from, int to) const override {
    const int depth = paths_.depth[from];
    if (depth < 0) return paths_.switches + 1;
    return to == goal_ ? paths_.switches - depth : depth;
  }

 private:
  const SwitchingGraph& graph_;
  const ShortestPaths& paths_;
  int goal_;
};

/// Worse than every score of a GraspEvaluator: a sequence that fingers cannot carry out.
constexpr double kScoreOfObstacle = -2;

std::optional<PlanObstacle> FindObstacle(const CandidateSequence& draft,
                                         const GraspEvaluator& evaluator) {
  return FindPlanObstacle(evaluator.object(), draft.initial, draft.steps,
                          evaluator.finger_radius());
}

/// The switch that a step belongs to: the one that the grasp after it was chosen for, or else the
/// last one before or the first one after it.
std::optional<VertexPair> EdgeNear(const CandidateSequence& draft, int step) {
  for (int i = step; i >= 0; --i) {
    if (draft.rests[i].chosen_for) return draft.rests[i].chosen_for;
  }
  for (const Rest& rest : draft.rests) {
    if (rest.chosen_for) return rest.chosen_for;
  }
  return std::nullopt;
}

}  // namespace

PlanResult ResultOf(const NoGrasp& none) {
  PlanResult result;
  result.status = PlanResult::Status::kNoGrasp;
  result.message = none.message;
  return result;
}

PlanResult ResultOf(const TimeUp& time_up, const std::string& planner) {
  PlanResult result;
  result.status = PlanResult::Status::kNoSequence;
  result.message = "no sequence was found by the planner " + planner + " when " + time_up.what();
  return result;
}

void CheckMemory(const std::function<MemoryNeed()>& estimate, double limit) {
  if (!std::isfinite(limit)) return;
  const std::string why = MemoryComplaint(estimate(), limit);
  if (!why.empty()) throw NoGrasp{why};
}

SamplingPools StartPools(int set_count) {
  std::vector<int> all(set_count);
  std::iota(all.begin(), all.end(), 0);
  return {all};
}

SamplingPools GoalPools(const Components& components, const std::set<int>& start_sets) {
  std::set<int> reachable;
  for (const int set : start_sets) reachable.insert(components.of_vertex[set]);
  std::vector<int> others;
  for (int set = 0; set < static_cast<int>(components.of_vertex.size()); ++set) {
    if (reachable.contains(components.of_vertex[set]) && !start_sets.contains(set)) {
      others.push_back(set);
    }
  }
  return {others, {start_sets.begin(), start_sets.end()}};
}

Grasp DrawFromSets(const GraspChoice& choice, SamplingPools pools,
                   const std::function<Grasp(int set)>& draw, const GraspEvaluator& evaluator,
                   RandomStream& random) {
  std::size_t sets = 0;
  for (std::vector<int>& pool : pools) {
    sets += pool.size();
    const std::size_t draws = std::min(pool.size(), kMaxSetDraws);
    for (std::size_t i = 0; i < draws; ++i) {
      std::swap(pool[i], pool[i + random.Index(pool.size() - i)]);
      for (int k = 0; k < kDrawsPerSet; ++k) {
        Grasp grasp = draw(pool[i]);
        if (!grasp.empty() && evaluator.IsGood(grasp)) return grasp;
      }
    }
  }
  throw NoGrasp{choice.name + ": no grasp with a quality of at least " +
                FormatShort(evaluator.min_quality()) + " was drawn from " + std::to_string(sets) +
                " sets of grasps" + (pools.size() > 1 ? " in the start's component" : "")};
}

PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan) {
  std::optional<PlanResult> first;
  for (int draw = 1; draw <= kGoalDraws; ++draw) {
    try {
      PlanResult result = plan(draw == kGoalDraws);
      if (result.plan && result.warnings.empty()) return result;
      if (!first) first = std::move(result);
    } catch (const TimeUp&) {
      if (!first) throw;
      break;
    }
  }
  return *first;
}

void GraphWithout::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  graph_.GetNeighbours(vertex, neighbours);
  if (banned_.empty()) return;
  std::erase_if(neighbours, [&](int other) { return banned_.contains(Unordered(vertex, other)); });
}

std::vector<int> FindWidePath(const SwitchingGraph& graph, int start, int goal,
                              const VertexWidth& width) {
  const auto ways = FindShortestPaths(graph, start, goal);
  if (!ways) return {};
  const OnShortestPaths on_paths(graph, *ways, goal);
  return WidestPath(
      on_paths, start, goal, ways->switches, [](int) { return true; }, width);
}

std::optional<CandidateSequence> FindCandidate(
    const GraspEvaluator& evaluator,
    const std::function<std::vector<int>(const std::set<VertexPair>& banned)>& find_path,
    const std::function<std::optional<CandidateSequence>(const std::vector<int>& path,
                                                         std::set<VertexPair>& banned)>& make,
    const Deadline& deadline) {
  // Where no way is free for the fingers' radius, the result is told so (ResultOf).
  std::optional<CandidateSequence> best;
  double best_score = -std::numeric_limits<double>::infinity();
  std::set<VertexPair> banned;
  for (int attempt = 0; attempt < kMaxPaths; ++attempt) {
    std::optional<CandidateSequence> draft;
    try {
      deadline.Check();
      const std::vector<int> path = find_path(banned);
      if (path.empty()) break;
      draft = make(path, banned);
    } catch (const TimeUp&) {
      if (!best) throw;
      break;
    }
    if (!draft) continue;
    double score = std::numeric_limits<double>::infinity();
    for (const Rest& rest : draft->rests) {
      if (!rest.chosen_for) continue;
      const double of_rest = evaluator.Score(rest.grasp);
      if (of_rest < 0) banned.insert(*rest.chosen_for);
      score = std::min(score, of_rest);
    }
    const auto obstacle = FindObstacle(*draft, evaluator);
    if (obstacle) {
      const auto edge = EdgeNear(*draft, obstacle->index);
      if (!edge) return draft;
      banned.insert(*edge);
      score = std::min(score, kScoreOfObstacle);
    }
    if (score >= 0) return draft;
    if (best && score <= best_score) continue;
    best = std::move(draft);
    best_score = score;
  }
  return best;
}

PlanResult ResultOf(const CandidateSequence& draft, const GraspEvaluator& evaluator,
                    const std::string& planner, int fingers, const Grasp& goal) {
  if (const auto obstacle = FindObstacle(draft, evaluator)) {
    PlanResult none;
    none.status = PlanResult::Status::kNoSequence;
    none.message = "the planner " + planner + " found no sequence for fingers of radius " +
                   FormatShort(evaluator.finger_radius()) + "; in the best one, step " +
                   std::to_string(obstacle->index) + ": " + obstacle->detail;
    return none;
  }
  Plan plan;
  plan.dimension = evaluator.frame().dimension;
  plan.half_angle = evaluator.half_angle();
  plan.fingers = fingers;
  plan.planner = planner;
  if (evaluator.finger_radius() > 0) plan.finger_radius = evaluator.finger_radius();
  plan.initial = draft.initial;
  plan.steps = draft.steps;
  plan.goal = goal;
  PlanResult result;
  result.plan = std::move(plan);
  result.margin = SmallestMargin(draft.rests, evaluator);
  result.warnings = QualityWarnings(draft.rests, evaluator);
  return result;
}

}  // namespace regrasp
