#include "planner/search/widest_path.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace regrasp::search {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The largest width among the vertices next to `end` that a sequence to `other` in `switches`
/// switches may pass: no sequence is wider. −∞ where there is none.
double BestBeside(const SwitchingGraph& graph, int end, int other, int switches,
                  const VertexFilter& admits, const VertexWidth& width) {
  std::vector<int> neighbours;
  graph.GetNeighbours(end, neighbours);
  std::vector<std::pair<double, int>> candidates;
  for (const int neighbour : neighbours) {
    if (neighbour == other || 1 + graph.MinSwitches(neighbour, other) > switches) continue;
    candidates.emplace_back(width(neighbour), neighbour);
  }
  std::sort(candidates.begin(), candidates.end(), std::greater<>());
  for (const auto& [candidate_width, vertex] : candidates) {
    if (admits(vertex)) return candidate_width;
  }
  return -kUnbounded;
}

/// A vertex at a depth, reached over a sequence with a bottleneck.
struct State {
  double bottleneck;
  int depth;
  double width;  ///< of the vertex alone, so that equals prefer the better grasp
  int vertex;
  int previous;

  [[nodiscard]] auto Rank() const {
    return std::tuple(bottleneck, depth, width, -vertex, -previous);
  }
  friend bool operator<(const State& a, const State& b) { return a.Rank() < b.Rank(); }
};

class WidestPathSearch {
 public:
  WidestPathSearch(const SwitchingGraph& graph, int start, int goal, int switches,
                   const VertexFilter& admits, const VertexWidth& width)
      : graph_(graph),
        start_(start),
        goal_(goal),
        switches_(switches),
        admits_(admits),
        width_(width),
        cap_(Cap()) {}

  [[nodiscard]] std::vector<int> Run() {
    queue_.push({kUnbounded, 0, kUnbounded, start_, start_});
    while (!queue_.empty()) {
      const State state = queue_.top();
      queue_.pop();
      if (previous_.contains(Key(state.vertex, state.depth))) continue;
      const bool inner = state.vertex != start_ && state.vertex != goal_;
      if (inner && !admits_(state.vertex)) continue;
      previous_[Key(state.vertex, state.depth)] = state.previous;
      if (state.vertex == goal_) return PathTo(state.depth);
      Expand(state);
    }
    return {};
  }

 private:
  double Cap() const {
    if (switches_ < 2) return kUnbounded;
    return std::min(BestBeside(graph_, start_, goal_, switches_, admits_, width_),
                    BestBeside(graph_, goal_, start_, switches_, admits_, width_));
  }

  void Expand(const State& state) {
    const int depth = state.depth + 1;
    graph_.GetNeighbours(state.vertex, neighbours_);
    for (const int neighbour : neighbours_) {
      if (depth + graph_.MinSwitches(neighbour, goal_) > switches_) continue;
      if (neighbour == start_ || (neighbour == goal_) != (depth == switches_)) continue;
      if (previous_.contains(Key(neighbour, depth))) continue;
      const double width = neighbour == goal_ ? kUnbounded : std::min(cap_, width_(neighbour));
      const double bottleneck = std::min(state.bottleneck, width);
      queue_.push({bottleneck, depth, neighbour == goal_ ? kUnbounded : width_(neighbour),
                   neighbour, state.vertex});
    }
  }

  [[nodiscard]] std::vector<int> PathTo(int depth) const {
    std::vector<int> path = {goal_};
    for (; depth > 0; --depth) path.push_back(previous_.at(Key(path.back(), depth)));
    std::reverse(path.begin(), path.end());
    return path;
  }

  [[nodiscard]] std::int64_t Key(int vertex, int depth) const {
    return std::int64_t{vertex} * (switches_ + 1) + depth;
  }

  const SwitchingGraph& graph_;
  int start_;
  int goal_;
  int switches_;
  const VertexFilter& admits_;
  const VertexWidth& width_;
  double cap_;
  std::priority_queue<State> queue_;
  std::unordered_map<std::int64_t, int> previous_;  ///< of the states that are settled
  std::vector<int> neighbours_;
};

}  // namespace

std::vector<int> WidestPath(const SwitchingGraph& graph, int start, int goal, int switches,
                            const VertexFilter& admits, const VertexWidth& width) {
  if (start == goal) return switches == 0 ? std::vector<int>{start} : std::vector<int>{};
  return WidestPathSearch(graph, start, goal, switches, admits, width).Run();
}

}  // namespace regrasp::search
