#include "planner/sets/candidate_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "planner/planning/candidate_sequence.h"
#include "planner/search/switching_graph.h"

namespace regrasp::sets {

namespace {

/// Paths tried for one whose grasps are all of the quality that is asked for.
constexpr int kMaxPaths = 600;

/// A graph that knows how far it is to its ends on the shortest paths: a search over sequences with
/// the fewest switches looks at nothing beside them.
class OnShortestPaths final : public search::SwitchingGraph {
 public:
  /// Both must outlive this object.
  OnShortestPaths(const search::SwitchingGraph& graph, const search::ShortestPaths& paths, int goal)
      : graph_(graph), paths_(paths), goal_(goal) {}

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
  const search::SwitchingGraph& graph_;
  const search::ShortestPaths& paths_;
  int goal_;
};

/// Worse than every score of a GraspEvaluator: a sequence that fingers cannot carry out.
constexpr double kScoreOfObstacle = -2;

/// The switch that a step belongs to: the one that the grasp after it was chosen for, or else the
/// last one before or the first one after it.
std::optional<search::VertexPair> EdgeNear(const planning::CandidateSequence& candidate, int step) {
  for (int i = step; i >= 0; --i) {
    if (candidate.grasps[i].chosen_for) return candidate.grasps[i].chosen_for;
  }
  for (const planning::StaticGrasp& rest : candidate.grasps) {
    if (rest.chosen_for) return rest.chosen_for;
  }
  return std::nullopt;
}

/// Bans the switches to grasps that were chosen and are not good enough.
/// @returns whether there are any.
bool BanPoor(const planning::CandidateSequence& candidate,
             const criteria::GraspEvaluator& evaluator, std::set<search::VertexPair>& banned) {
  bool any = false;
  for (const planning::StaticGrasp& rest : candidate.grasps) {
    if (!rest.chosen_for || evaluator.Margin(rest.grasp)) continue;
    banned.insert(*rest.chosen_for);
    any = true;
  }
  return any;
}

/// A sequence that is not as good as asked.
struct PoorCandidate {
  planning::CandidateSequence sequence;
  bool has_obstacle;
};

/// The worst score of the grasps that were chosen.
double ScoreOf(const PoorCandidate& candidate, const criteria::GraspEvaluator& evaluator) {
  double worst =
      candidate.has_obstacle ? kScoreOfObstacle : std::numeric_limits<double>::infinity();
  for (const planning::StaticGrasp& rest : candidate.sequence.grasps) {
    if (rest.chosen_for) worst = std::min(worst, evaluator.Score(rest.grasp));
  }
  return worst;
}

/// Scores of grasps that are not good take long: they are worked out only where nothing is good.
std::optional<planning::CandidateSequence> BestOf(std::vector<PoorCandidate> candidates,
                                                  const criteria::GraspEvaluator& evaluator) {
  if (candidates.empty()) return std::nullopt;
  const auto best = std::ranges::max_element(
      candidates, {}, [&](const PoorCandidate& c) { return ScoreOf(c, evaluator); });
  return std::move(best->sequence);
}

}  // namespace

std::vector<int> FindWidePath(const search::SwitchingGraph& graph, int start, int goal,
                              const search::VertexWidth& width) {
  const auto paths = search::FindShortestPaths(graph, start, goal);
  if (!paths) return {};
  const OnShortestPaths on_paths(graph, *paths, goal);
  return search::WidestPath(
      on_paths, start, goal, paths->switches, [](int) { return true; }, width);
}

std::optional<planning::CandidateSequence> FindCandidate(
    const criteria::GraspEvaluator& evaluator,
    const std::function<std::vector<int>(const std::set<search::VertexPair>& banned)>& find_path,
    const std::function<std::optional<planning::CandidateSequence>(
        const std::vector<int>& path, std::set<search::VertexPair>& banned)>& make,
    const Deadline& deadline) {
  // Where no path is free for the fingers' radius, the result is told so (ResultOf).
  std::vector<PoorCandidate> poor;
  std::set<search::VertexPair> banned;
  for (int attempt = 0; attempt < kMaxPaths; ++attempt) {
    std::optional<planning::CandidateSequence> candidate;
    try {
      deadline.Check();
      const std::vector<int> path = find_path(banned);
      if (path.empty()) break;
      candidate = make(path, banned);
    } catch (const TimeUp&) {
      if (poor.empty()) throw;
      break;
    }
    if (!candidate) continue;
    const bool is_poor = BanPoor(*candidate, evaluator, banned);
    const auto obstacle = planning::FindObstacle(*candidate, evaluator);
    if (!is_poor && !obstacle) return candidate;
    if (obstacle) {
      const auto edge = EdgeNear(*candidate, obstacle->index);
      if (!edge) return candidate;
      banned.insert(*edge);
    }
    poor.push_back({*std::move(candidate), obstacle.has_value()});
  }
  return BestOf(std::move(poor), evaluator);
}

}  // namespace regrasp::sets
