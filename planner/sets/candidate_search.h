#pragma once

#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/search/switching_graph.h"
#include "planner/search/widest_path.h"

namespace regrasp::sets {

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
