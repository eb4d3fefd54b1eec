#include "planner/search/shortest_paths.h"

#include <algorithm>

namespace regrasp::search {

namespace {

constexpr int kUnreached = -1;

/// The vertices around one end, by layers.
class Ball {
 public:
  Ball(const SwitchingGraph& graph, int centre)
      : graph_(graph), distance_(graph.vertex_count(), kUnreached), layers_{{centre}} {
    distance_[centre] = 0;
  }

  [[nodiscard]] int radius() const { return static_cast<int>(layers_.size()) - 1; }
  [[nodiscard]] const std::vector<int>& front() const { return layers_.back(); }
  [[nodiscard]] int DistanceOf(int vertex) const { return distance_[vertex]; }

  void Grow() {
    std::vector<int> next;
    for (const int vertex : layers_.back()) {
      graph_.GetNeighbours(vertex, neighbours_);
      for (const int neighbour : neighbours_) {
        if (distance_[neighbour] != kUnreached) continue;
        distance_[neighbour] = radius() + 1;
        next.push_back(neighbour);
      }
    }
    layers_.push_back(std::move(next));
  }

  /// The vertices of the ball's layer `distance` beside some of the layer after it.
  [[nodiscard]] std::vector<int> Inwards(const std::vector<int>& outer, int distance) {
    std::vector<int> inner;
    for (const int vertex : outer) {
      graph_.GetNeighbours(vertex, neighbours_);
      for (const int neighbour : neighbours_) {
        if (distance_[neighbour] != distance) continue;
        inner.push_back(neighbour);
        distance_[neighbour] = kUnreached;  // once is enough
      }
    }
    return inner;
  }

 private:
  const SwitchingGraph& graph_;
  std::vector<int> distance_;
  std::vector<std::vector<int>> layers_;
  std::vector<int> neighbours_;
};

}  // namespace

std::optional<ShortestPaths> FindShortestPaths(const SwitchingGraph& graph, int start, int goal) {
  Ball from_start(graph, start);
  Ball from_goal(graph, goal);
  // The fronts are the only layers that can meet: a layer further in would have met before.
  std::vector<int> middle;
  while (true) {
    std::ranges::copy_if(from_start.front(), std::back_inserter(middle), [&](int vertex) {
      return from_goal.DistanceOf(vertex) == from_goal.radius();
    });
    if (!middle.empty()) break;
    if (from_start.front().empty() || from_goal.front().empty()) return std::nullopt;
    (from_start.front().size() <= from_goal.front().size() ? from_start : from_goal).Grow();
  }
  ShortestPaths paths;
  paths.switches = from_start.radius() + from_goal.radius();
  paths.depth.assign(graph.vertex_count(), kUnreached);
  const auto keep = [&](Ball& ball, const auto& depth_at) {
    std::vector<int> layer = middle;
    for (const int vertex : layer) paths.depth[vertex] = depth_at(ball.radius());
    for (int distance = ball.radius() - 1; distance >= 0; --distance) {
      layer = ball.Inwards(layer, distance);
      for (const int vertex : layer) paths.depth[vertex] = depth_at(distance);
    }
  };
  keep(from_start, [](int distance) { return distance; });
  keep(from_goal, [&](int distance) { return paths.switches - distance; });
  return paths;
}

}  // namespace regrasp::search
