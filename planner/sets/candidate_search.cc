#include "planner/sets/candidate_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "planner/planning/candidate_sequence.h"
#include "planner/search/switching_graph.h"

namespace regrasp::sets {

namespace {

/// Maximum number of paths in the search for one that meets the acceptance criteria.
constexpr int kMaxPaths = 600;

/// Graph with exact distances to start and goal. A search for sequences with the fewest switches
/// then visits shortest paths only.
class OnShortestPaths final : public search::SwitchingGraph {
 public:
  /// @param graph, paths  must outlive this object.
  OnShortestPaths(const search::SwitchingGraph& graph, const search::ShortestPaths& paths, int goal)
      : graph_(graph), paths_(paths), goal_(goal) {}

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count(); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    graph_.GetNeighbours(vertex, neighbours);
  }
  /// @param to  start or goal vertex.
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

/// Score of a sequence that the fingers cannot execute, below every score of a GraspEvaluator.
constexpr double kScoreOfObstacle = -2;

/// Return the edge of a step: that of the grasp after it; otherwise the last one before or the
/// first one after it.
std::optional<search::VertexPair> EdgeNear(const planning::CandidateSequence& candidate, int step) {
  for (int i = step; i >= 0; --i) {
    if (candidate.rests[i].chosen_for) return candidate.rests[i].chosen_for;
  }
  for (const planning::Rest& rest : candidate.rests) {
    if (rest.chosen_for) return rest.chosen_for;
  }
  return std::nullopt;
}

/// Ban the switches to chosen grasps that do not meet the acceptance criteria.
/// @returns whether there is any.
bool BanPoor(const planning::CandidateSequence& candidate,
             const criteria::GraspEvaluator& evaluator, std::set<search::VertexPair>& banned) {
  bool any = false;
  for (const planning::Rest& rest : candidate.rests) {
    if (!rest.chosen_for || evaluator.Margin(rest.grasp)) continue;
    banned.insert(*rest.chosen_for);
    any = true;
  }
  return any;
}

/// Sequence that does not meet the acceptance criteria.
struct PoorCandidate {
  planning::CandidateSequence sequence;
  bool has_obstacle;
};

/// Return the lowest score of the chosen grasps.
double ScoreOf(const PoorCandidate& candidate, const criteria::GraspEvaluator& evaluator) {
  double worst =
      candidate.has_obstacle ? kScoreOfObstacle : std::numeric_limits<double>::infinity();
  for (const planning::Rest& rest : candidate.sequence.rests) {
    if (rest.chosen_for) worst = std::min(worst, evaluator.Score(rest.grasp));
  }
  return worst;
}

/// Return the sequence with the best score. Scores of grasps that fail the criteria are expensive,
/// so they are computed only if no sequence meets the criteria.
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
  // If no path is free for the fingers' radius, ResultOf reports it.
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
