#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/search/switching_graph.h"

namespace regrasp::sets {

/// Index of a convex piece in its set.
using PieceIndex = Index<struct PieceTag>;

/// Find the waypoints of a sliding step through the convex pieces of a set.
///
/// There is one waypoint in each passage between two pieces. Breadth-first search minimizes their
/// number.
/// @param starts, goals  for each piece, whether it contains the first or last grasp of the step.
/// @param find_passage   function that returns the waypoint between two pieces; nullopt if there is
///     none.
/// @returns an empty vector if one piece contains both grasps; nullopt if the pieces are not
///     connected.
template <class Waypoint>
[[nodiscard]] std::optional<std::vector<Waypoint>> FindPassages(
    const std::vector<bool>& starts, const std::vector<bool>& goals,
    const std::function<std::optional<Waypoint>(PieceIndex from, PieceIndex to)>& find_passage) {
  const int count = static_cast<int>(starts.size());
  std::vector<bool> seen = starts;
  std::vector<PieceIndex> before(count);  // invalid for a start piece
  std::vector<Waypoint> through(count);
  std::deque<PieceIndex> queue;
  for (PieceIndex piece{0}; piece < count; ++piece) {
    if (!starts[piece]) continue;
    if (goals[piece]) return std::vector<Waypoint>();
    queue.push_back(piece);
  }
  for (; !queue.empty(); queue.pop_front()) {
    for (PieceIndex next{0}; next < count; ++next) {
      if (seen[next]) continue;
      std::optional<Waypoint> passage = find_passage(queue.front(), next);
      if (!passage) continue;
      seen[next] = true;
      before[next] = queue.front();
      through[next] = std::move(*passage);
      queue.push_back(next);
      if (!goals[next]) continue;
      std::vector<Waypoint> path;
      for (PieceIndex at = next; before[at].valid(); at = before[at]) path.push_back(through[at]);
      std::ranges::reverse(path);
      return path;
    }
  }
  return std::nullopt;
}

/// Find the widest of the paths with the fewest switches.
/// @returns its vertices; empty if there is no path.
[[nodiscard]] std::vector<int> FindWidePath(const search::SwitchingGraph& graph, int start,
                                            int goal, const search::VertexWidth& width);

/// Find a sequence whose chosen grasps all meet the acceptance criteria.
///
/// After a failure, the search bans the switches that do not meet them, or that the hand cannot
/// execute, and tries another path. If no sequence meets the criteria, or at the deadline, the
/// result is the sequence whose weakest grasp is best.
/// @param find_path  function that returns a path without banned edges; empty if there is none.
/// @param make  function that returns the sequence of a path. If it returns nullopt, it has banned
///     at least one more edge.
/// @throws TimeUp  if the deadline is reached before the first sequence.
[[nodiscard]] std::optional<planning::CandidateSequence> FindCandidate(
    const criteria::GraspEvaluator& evaluator,
    const std::function<std::vector<int>(const std::set<search::VertexPair>& banned)>& find_path,
    const std::function<std::optional<planning::CandidateSequence>(
        const std::vector<int>& path, std::set<search::VertexPair>& banned)>& make,
    const Deadline& deadline = {});

}  // namespace regrasp::sets
