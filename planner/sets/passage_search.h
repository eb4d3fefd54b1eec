#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace regrasp::sets {

/// The waypoints of an align through the convex pieces of a set: one in each passage between two of
/// them, fewest passages first (breadth first).
/// @param starts, goals  of each piece, whether it contains the align's first grasp, or its last.
/// @param find_passage   where an align can pass from one piece to another.
/// @returns none where a piece contains both; nullopt where no chain of pieces joins them.
template <class Waypoint>
[[nodiscard]] std::optional<std::vector<Waypoint>> FindPassages(
    const std::vector<bool>& starts, const std::vector<bool>& goals,
    const std::function<std::optional<Waypoint>(int from, int to)>& find_passage) {
  constexpr int kUnseen = -2;
  constexpr int kStart = -1;
  const int count = static_cast<int>(starts.size());
  std::vector<int> before(count, kUnseen);
  std::vector<Waypoint> through(count);
  std::deque<int> queue;
  for (int piece = 0; piece < count; ++piece) {
    if (!starts[piece]) continue;
    if (goals[piece]) return std::vector<Waypoint>();
    before[piece] = kStart;
    queue.push_back(piece);
  }
  for (; !queue.empty(); queue.pop_front()) {
    for (int next = 0; next < count; ++next) {
      if (before[next] != kUnseen) continue;
      std::optional<Waypoint> passage = find_passage(queue.front(), next);
      if (!passage) continue;
      before[next] = queue.front();
      through[next] = std::move(*passage);
      queue.push_back(next);
      if (!goals[next]) continue;
      std::vector<Waypoint> path;
      for (int at = next; before[at] != kStart; at = before[at]) path.push_back(through[at]);
      std::ranges::reverse(path);
      return path;
    }
  }
  return std::nullopt;
}

}  // namespace regrasp::sets
