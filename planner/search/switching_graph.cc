#include "planner/search/switching_graph.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace regrasp::search {

Components FindComponents(int vertex_count, int group_count,
                          const std::function<std::span<const int>(int group)>& members) {
  boost::disjoint_sets_with_storage<> sets(vertex_count);
  for (int group = 0; group < group_count; ++group) {
    const std::span<const int> vertices = members(group);
    for (const int vertex : vertices) sets.union_set(vertices.front(), vertex);
  }
  Components components;
  components.of_vertex.resize(vertex_count);
  std::vector<int> number(vertex_count, -1);
  for (int vertex = 0; vertex < vertex_count; ++vertex) {
    int& component = number[sets.find_set(vertex)];
    if (component < 0) {
      component = components.count();
      components.sizes.push_back(0);
    }
    components.of_vertex[vertex] = component;
    ++components.sizes[component];
  }
  return components;
}

namespace {

constexpr int kUnreached = -1;

/// Vertices around one end of a path, by layers.
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

  /// Return the vertices of layer `distance` that are adjacent to vertices of the next layer.
  [[nodiscard]] std::vector<int> Inwards(const std::vector<int>& outer, int distance) {
    std::vector<int> inner;
    for (const int vertex : outer) {
      graph_.GetNeighbours(vertex, neighbours_);
      for (const int neighbour : neighbours_) {
        if (distance_[neighbour] != distance) continue;
        inner.push_back(neighbour);
        distance_[neighbour] = kUnreached;  // each vertex is returned once
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
  // Only the fronts can meet, because inner layers would have met before.
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

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Return the largest width of an admitted neighbour of `end` on a path to `other` with `switches`
/// switches.
/// It is an upper bound of the width of every path; −∞ if there is none.
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

/// Vertex at a depth, with the bottleneck of its path.
struct State {
  double bottleneck;
  int depth;
  double width;  ///< width of the vertex only, which breaks ties in favour of better grasps
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
  std::unordered_map<std::int64_t, int> previous_;  ///< previous vertex of settled states
  std::vector<int> neighbours_;
};

}  // namespace

std::vector<int> WidestPath(const SwitchingGraph& graph, int start, int goal, int switches,
                            const VertexFilter& admits, const VertexWidth& width) {
  if (start == goal) return switches == 0 ? std::vector<int>{start} : std::vector<int>{};
  return WidestPathSearch(graph, start, goal, switches, admits, width).Run();
}

namespace {

constexpr int kUnreachedCount = std::numeric_limits<int>::max();

/// Breadth-first search that is advanced vertex by vertex.
class Flood {
 public:
  Flood(const SwitchingGraph& graph, int start, const VertexFilter& admits)
      : graph_(graph), admits_(admits), met_(graph.vertex_count(), false), queue_{start} {
    met_[start] = true;
  }

  /// Expand one vertex. Returns false if there is none.
  bool Step() {
    if (queue_.empty()) return false;
    const int vertex = queue_.front();
    queue_.pop_front();
    if (!reached_.empty() && !admits_(vertex)) return true;
    reached_.push_back(vertex);
    graph_.GetNeighbours(vertex, neighbours_);
    for (const int neighbour : neighbours_) {
      if (met_[neighbour]) continue;
      met_[neighbour] = true;
      queue_.push_back(neighbour);
    }
    return true;
  }

  /// Return whether the vertex is reached or adjacent to a reached vertex.
  [[nodiscard]] bool Met(int vertex) const { return met_[vertex]; }
  [[nodiscard]] std::vector<int> TakeReached() && { return std::move(reached_); }

 private:
  const SwitchingGraph& graph_;
  const VertexFilter& admits_;
  std::vector<bool> met_;
  std::deque<int> queue_;
  std::vector<int> reached_;
  std::vector<int> neighbours_;
};

/// A* over unit edges, advanced vertex by vertex.
/// Uses buckets instead of a heap, because totals are small integers and never decrease with a
/// consistent bound.
class AStar {
 public:
  AStar(const SwitchingGraph& graph, int start, int goal, const VertexFilter& admits)
      : graph_(graph), goal_(goal), admits_(admits), best_(graph.vertex_count(), kUnreachedCount) {
    Push(start, 0);
  }

  enum class State { kSearching, kFound, kExhausted };

  /// Expand one vertex.
  State Step() {
    while (total_ < buckets_.size() && buckets_[total_].empty()) ++total_;
    if (total_ == buckets_.size()) return State::kExhausted;
    // The latest entry comes first: among equal totals the search goes depth-first towards the
    // goal.
    const Entry entry = buckets_[total_].back();
    buckets_[total_].pop_back();
    if (entry.vertex == goal_) {
      distance_ = entry.distance;
      return State::kFound;
    }
    if (entry.distance > best_[entry.vertex]) return State::kSearching;
    if (entry.distance > 0 && !admits_(entry.vertex)) return State::kSearching;
    graph_.GetNeighbours(entry.vertex, neighbours_);
    for (const int neighbour : neighbours_) Push(neighbour, entry.distance + 1);
    return State::kSearching;
  }

  [[nodiscard]] int distance() const { return distance_; }

 private:
  struct Entry {
    int vertex;
    int distance;
  };

  void Push(int vertex, int distance) {
    if (distance >= best_[vertex]) return;
    best_[vertex] = distance;
    const std::size_t total = distance + graph_.MinSwitches(vertex, goal_);
    if (total >= buckets_.size()) buckets_.resize(total + 1);
    buckets_[total].push_back({vertex, distance});
  }

  const SwitchingGraph& graph_;
  int goal_;
  const VertexFilter& admits_;
  std::vector<int> best_;  ///< shortest known distance from the start
  std::vector<std::vector<Entry>> buckets_;
  std::size_t total_ = 0;
  int distance_ = 0;
  std::vector<int> neighbours_;
};

}  // namespace

std::optional<int> FewestSwitches(const SwitchingGraph& graph, int start, int goal,
                                  const VertexFilter& admits) {
  AStar search(graph, start, goal, admits);
  Flood from_goal(graph, goal, admits);
  while (true) {
    switch (search.Step()) {
      case AStar::State::kFound:
        return search.distance();
      case AStar::State::kExhausted:
        return std::nullopt;
      case AStar::State::kSearching:
        break;
    }
    // The start counts as reached even if the filter does not admit it.
    if (!from_goal.Met(start) && !from_goal.Step()) return std::nullopt;
  }
}

std::vector<int> ReachableVertices(const SwitchingGraph& graph, int start,
                                   const VertexFilter& admits) {
  Flood flood(graph, start, admits);
  while (flood.Step()) {
  }
  return std::move(flood).TakeReached();
}

}  // namespace regrasp::search
