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

/// A convex piece of a set, by its number in the set.
using PieceIndex = Index<struct PieceTag>;

/// The waypoints of an align through the convex pieces of a set: one in each passage between two of
/// them, fewest passages first (breadth first).
/// @param starts, goals  of each piece, whether it contains the align's first grasp, or its last.
/// @param find_passage   where an align can pass from one piece to another.
/// @returns none where a piece contains both; nullopt where no chain of pieces joins them.
template <class Waypoint>
[[nodiscard]] std::optional<std::vector<Waypoint>> FindPassages(
    const std::vector<bool>& starts, const std::vector<bool>& goals,
    const std::function<std::optional<Waypoint>(PieceIndex from, PieceIndex to)>& find_passage) {
  const int count = static_cast<int>(starts.size());
  std::vector<bool> seen = starts;
  std::vector<PieceIndex> before(count);  // not valid before a start
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

/// The vertices of a path with the fewest switches, of these the widest; empty where there is none.
[[nodiscard]] std::vector<int> FindWidePath(const search::SwitchingGraph& graph, int start,
                                            int goal, const search::VertexWidth& width);

/// The first sequence whose chosen grasps are all of the quality that is asked for, otherwise the
/// one whose weakest is best: paths are tried without the switches that were too weak before, or
/// that fingers of the evaluator's hand could not carry out. Where the time is up, the best so far.
/// @param find_path  a path without banned edges; empty where there is none.
/// @param make       its sequence, or nullopt and at least one more edge banned.
/// @throws TimeUp  before there was one.
[[nodiscard]] std::optional<planning::CandidateSequence> FindCandidate(
    const criteria::GraspEvaluator& evaluator,
    const std::function<std::vector<int>(const std::set<search::VertexPair>& banned)>& find_path,
    const std::function<std::optional<planning::CandidateSequence>(
        const std::vector<int>& path, std::set<search::VertexPair>& banned)>& make,
    const Deadline& deadline = {});

}  // namespace regrasp::sets
