#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/plan/plan.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/planning/plan_request.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/sets/candidate_search.h"
#include "planner/sets/sequence_builder.h"
#include "planner/sets/set_graph.h"

namespace regrasp::sets {

/// Planner of one sequence over a model of grasp sets: state shared by its stages.
template <GraspSetModel Model>
class SetPlanner {
 public:
  /// The model and the request must outlive this object.
  SetPlanner(Model& model, const planning::PlanRequest& request, std::string planner)
      : model_(model),
        request_(request),
        planner_(std::move(planner)),
        of_start_(request.seed, RandomUse::kStart),
        of_goal_(request.seed, RandomUse::kGoal) {}

  [[nodiscard]] planning::PlanResult Plan() {
    start_ = request_.start.grasp;
    if (IsRandom(request_.start)) {
      start_ = Draw(request_.start, StartPools(model_.graph().vertex_count()), of_start_);
    }
    if (!IsRandom(request_.goal)) {
      goal_ = request_.goal.grasp;
      // If the goal is the start, the grasp need not be in a set.
      if (IsGoalTheStart()) return Finish(planning::StartOf(start_));
      start_at_ = Attach(request_.start, start_);
      return PlanToGoal();
    }
    start_at_ = Attach(request_.start, start_);
    return planning::PlanToRandomGoal([&](bool last) {
      SamplingPools pools = GoalPools(model_.graph().components(), SetsOf(start_at_));
      if (last) pools.erase(pools.begin());
      goal_ = Draw(request_.goal, std::move(pools), of_goal_);
      return IsGoalTheStart() ? Finish(planning::StartOf(start_)) : PlanToGoal();
    });
  }

 private:
  using Place = typename Model::Place;
  using Attachments = typename Model::Attachments;

  static bool IsRandom(const planning::GraspChoice& choice) {
    return choice.kind == planning::GraspChoice::Kind::kRandom;
  }

  [[nodiscard]] grasp::Grasp Draw(const planning::GraspChoice& choice, SamplingPools pools,
                                  RandomStream& random) {
    return DrawFromSets(
        choice.name, std::move(pools),
        [&](SetIndex set) {
          request_.deadline.Check();
          const auto place = model_.Draw(set, random);
          return place ? model_.GraspOf(*place) : grasp::Grasp();
        },
        model_.evaluator(), random);
  }

  [[nodiscard]] bool IsGoalTheStart() const {
    return plan::AreSameGrasp(start_, goal_, object::kPointTolerance * request_.object->diameter());
  }

  [[nodiscard]] Attachments Attach(const planning::GraspChoice& choice, const grasp::Grasp& grasp) {
    Attachments found = model_.Attach(grasp);
    if (found.empty()) {
      throw sampling::NoGrasp{choice.name + ": force closure, but " + model_.WhyUnattached(grasp)};
    }
    return found;
  }

  [[nodiscard]] static std::set<SetIndex> SetsOf(const Attachments& attachments) {
    std::set<SetIndex> sets;
    for (const auto& a : attachments) sets.insert(a.set);
    return sets;
  }

  [[nodiscard]] static GraspEnds EndsOf(const Attachments& attachments) {
    GraspEnds ends;
    for (const auto& a : attachments) {
      (a.whole ? ends.of_itself : ends.by_switch).insert(a.set);
    }
    return ends;
  }

  /// Return the best place of a grasp in a set.
  [[nodiscard]] static const Place& PlaceIn(const Attachments& attachments, SetIndex set) {
    return std::ranges::find(attachments, set, &Attachment<Place>::set)->place;
  }

  [[nodiscard]] planning::PlanResult PlanToGoal() {
    goal_at_ = Attach(request_.goal, goal_);
    request_.progress("searching a sequence among " +
                      std::to_string(model_.graph().vertex_count()) + " " + model_.sets_name());
    SequenceBuilder<Model> builder(model_, start_, goal_, request_.hand.fingers);
    const auto candidate = FindCandidate(
        model_.evaluator(), [&](const auto& banned) { return FindPath(banned); },
        [&](const std::vector<int>& vertices, auto& banned) {
          const std::vector<SetIndex> path(vertices.begin(), vertices.end());
          return builder.Make(path, PlaceIn(start_at_, path.front()),
                              PlaceIn(goal_at_, path.back()), banned);
        },
        request_.deadline);
    if (candidate) return Finish(*candidate);
    planning::PlanResult none;
    none.status = planning::PlanResult::Status::kNoSequence;
    none.message = NoSequenceMessage();
    return none;
  }

  /// Find the sets of the widest sequence with the fewest switches.
  [[nodiscard]] std::vector<int> FindPath(const std::set<search::VertexPair>& banned) {
    const AttachedGraph graph(model_.graph(), EndsOf(start_at_), EndsOf(goal_at_), banned);
    std::vector<int> path = FindWidePath(graph, graph.start(), graph.goal(), [&](int vertex) {
      request_.deadline.Check();
      const bool counts = graph.IsSet(vertex) && !graph.IsOnlySetOfAnEnd(vertex);
      return counts ? model_.WidthOf(SetIndex(vertex)) : std::numeric_limits<double>::infinity();
    });
    std::erase_if(path, [&](int vertex) { return !graph.IsSet(vertex); });
    return path;
  }

  [[nodiscard]] planning::PlanResult Finish(const planning::CandidateSequence& candidate) const {
    return planning::ResultOf(candidate, model_.evaluator(), planner_, request_, goal_);
  }

  [[nodiscard]] std::string NoSequenceMessage() const {
    const search::Components components = model_.graph().components();
    const auto size = [&](const Attachments& attachments) {
      std::set<int> reached;
      for (const SetIndex set : SetsOf(attachments)) reached.insert(components.of_vertex[set]);
      return std::to_string(std::accumulate(
          reached.begin(), reached.end(), 0,
          [&](int sum, int component) { return sum + components.sizes[component]; }));
    };
    return "no sequence of switches and sliding steps from start to goal: of " +
           std::to_string(model_.graph().vertex_count()) + " " + model_.sets_name() +
           " the start's component has " + size(start_at_) + ", the goal's " + size(goal_at_);
  }

  Model& model_;
  const planning::PlanRequest& request_;
  std::string planner_;
  RandomStream of_start_;
  RandomStream of_goal_;
  grasp::Grasp start_;
  grasp::Grasp goal_;
  Attachments start_at_;
  Attachments goal_at_;
};

/// Plan over a model of grasp sets, on an existing graph that can serve many queries.
///
/// The planner selects the widest of the paths with the fewest switches. If a switch's grasps do
/// not meet the acceptance criteria, it tries paths without this switch. If none meets them, a
/// warning names the weakest step. A random goal is redrawn if the sequence to it does not meet the
/// criteria.
/// @param request  same as for Planner::Plan.
/// @param planner  name of the planner, for plan and messages.
/// @throws NoGrasp  if no set contains the start or goal, or no random grasp is found.
/// @throws TimeUp  if the deadline is reached.
template <GraspSetModel Model>
[[nodiscard]] planning::PlanResult PlanOverSets(Model& model, const planning::PlanRequest& request,
                                                const std::string& planner) {
  return SetPlanner<Model>(model, request, planner).Plan();
}

}  // namespace regrasp::sets
