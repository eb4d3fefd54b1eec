#include "planner/search/fewest_switches.h"

#include <cstddef>
#include <deque>
#include <limits>

namespace regrasp::search {

namespace {

constexpr int kUnreachedCount = std::numeric_limits<int>::max();

/// Breadth-first search that is advanced vertex by vertex.
class Flood {
 public:
  Flood(const SwitchingGraph& graph, int start, const VertexFilter& admits)
      : graph_(graph), admits_(admits), met_(graph.vertex_count(), false), queue_{start} {
    met_[start] = true;
  }

  /// Expands one vertex. False where all are.
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

  /// Whether the vertex is reached or next to one that is.
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

/// A* over unit edges, advanced vertex by vertex. Buckets instead of a heap: totals are small
/// integers, and with a consistent bound they never fall.
class AStar {
 public:
  AStar(const SwitchingGraph& graph, int start, int goal, const VertexFilter& admits)
      : graph_(graph), goal_(goal), admits_(admits), best_(graph.vertex_count(), kUnreachedCount) {
    Push(start, 0);
  }

  enum class State { kSearching, kFound, kExhausted };

  /// Expands one vertex.
  State Step() {
    while (total_ < buckets_.size() && buckets_[total_].empty()) ++total_;
    if (total_ == buckets_.size()) return State::kExhausted;
    // The latest comes first: among equal totals the search dives towards the goal.
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
  std::vector<int> best_;  ///< distance from the start, as far as is known
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
    // The start counts as met whether or not the filter would let a sequence pass it.
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
