#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"
#include "planner/sampling/no_grasp.h"
#include "planner/search/components.h"
#include "planner/search/switching_graph.h"
#include "planner/search/widest_path.h"

namespace regrasp {

/// What planners over graphs of grasp sets have in common.

/// The answer of a planner that has no grasp: PlanResult::Status::kNoGrasp.
[[nodiscard]] PlanResult ResultOf(const NoGrasp& none);

/// The answer of a planner whose time was up.
[[nodiscard]] PlanResult ResultOf(const TimeUp& time_up, const std::string& planner);

/// Asks what a planner is about to take, where there is a limit.
/// @throws NoGrasp  more than `limit` bytes.
void CheckMemory(const std::function<MemoryNeed()>& estimate, double limit);

/// The sets that a random grasp is drawn from, those of the first list first.
using SamplingPools = std::vector<std::vector<int>>;

/// All sets, for a start.
[[nodiscard]] SamplingPools StartPools(int set_count);
/// For a goal: those in the components of the start's sets; the start's own where the others have
/// no grasp.
[[nodiscard]] SamplingPools GoalPools(const Components& components,
                                      const std::set<int>& start_sets);

/// Draws sets from pools and grasps from sets until one is good.
/// @param draw  gives a grasp of a set; an empty one where none was found.
/// @throws NoGrasp  none of many draws served.
[[nodiscard]] Grasp DrawFromSets(const GraspChoice& choice, SamplingPools pools,
                                 const std::function<Grasp(int set)>& draw,
                                 const GraspEvaluator& evaluator, RandomStream& random);

/// A random goal is drawn anew up to so many times while the sequence to it passes grasps that are
/// not as good as asked.
inline constexpr int kGoalDraws = 12;

/// The first plan without a warning of kGoalDraws, or else the first one; that one also where the
/// time is up for others.
/// @param plan  draws a goal and plans to it; the last time one that the start is in a set with.
[[nodiscard]] PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan);

/// A graph without some of its edges.
class GraphWithout final : public SwitchingGraph {
 public:
  /// Both must outlive this object.
  GraphWithout(const SwitchingGraph& graph, const std::set<VertexPair>& banned)
      : graph_(graph), banned_(banned) {}

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count(); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 private:
  const SwitchingGraph& graph_;
  const std::set<VertexPair>& banned_;
};

/// The vertices of a path with the fewest switches, of these the widest; empty where there is none.
[[nodiscard]] std::vector<int> FindWidePath(const SwitchingGraph& graph, int start, int goal,
                                            const VertexWidth& width);

/// The first sequence whose chosen grasps are all of the quality that is asked for, otherwise the
/// one whose weakest is best: paths are tried without the switches that were too weak before, or
/// that fingers of the judge's radius could not carry out. Where the time is up, the best so far.
/// @param find_path  a path without banned edges; empty where there is none.
/// @param make       its sequence, or nullopt and at least one more edge banned.
/// @throws TimeUp  before there was one.
[[nodiscard]] std::optional<CandidateSequence> FindCandidate(
    const GraspEvaluator& evaluator,
    const std::function<std::vector<int>(const std::set<VertexPair>& banned)>& find_path,
    const std::function<std::optional<CandidateSequence>(const std::vector<int>& path,
                                                         std::set<VertexPair>& banned)>& make,
    const Deadline& deadline = {});

/// The answer that a sequence is: none where fingers of the judge's radius cannot carry it out.
[[nodiscard]] PlanResult ResultOf(const CandidateSequence& draft, const GraspEvaluator& evaluator,
                                  const std::string& planner, int fingers, const Grasp& goal);

}  // namespace regrasp
