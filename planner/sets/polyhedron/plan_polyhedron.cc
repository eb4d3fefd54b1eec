#include "planner/sets/polyhedron/plan_polyhedron.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/plan/same_grasp.h"
#include "planner/planning/plan_search.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/sets/polyhedron/graph_memory.h"
#include "planner/sets/polyhedron/sequence_builder.h"

namespace regrasp {

namespace {

using Kind = GraspChoice::Kind;

constexpr int kContacts = 4;

/// A graph with a start and a goal grasp as vertices of their own, each joined to its cells.
class WithEnds final : public SwitchingGraph {
 public:
  WithEnds(const SwitchingGraph& graph, const PolyhedronSequenceBuilder::End& start,
           const PolyhedronSequenceBuilder::End& goal)
      : graph_(graph), start_(start), goal_(goal) {}

  [[nodiscard]] int start() const { return graph_.vertex_count(); }
  [[nodiscard]] int goal() const { return graph_.vertex_count() + 1; }
  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count() + 2; }

  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    if (vertex >= start()) {
      neighbours.clear();
      for (const FocusGrasp& at : (vertex == start() ? start_ : goal_).at) {
        neighbours.push_back(at.cell);
      }
      return;
    }
    graph_.GetNeighbours(vertex, neighbours);
    if (IsOf(start_, vertex)) neighbours.push_back(start());
    if (IsOf(goal_, vertex)) neighbours.push_back(goal());
  }

 private:
  static bool IsOf(const PolyhedronSequenceBuilder::End& end, int cell) {
    return std::ranges::find(end.at, cell, &FocusGrasp::cell) != end.at.end();
  }

  const SwitchingGraph& graph_;
  const PolyhedronSequenceBuilder::End& start_;
  const PolyhedronSequenceBuilder::End& goal_;
};

/// The planning of one sequence: what its stages share.
class PolyhedronPlanner {
 public:
  PolyhedronPlanner(const Polyhedron& solid, PolyhedronGraph& graph, GraspChoice start,
                    GraspChoice goal, const PolyhedronPlanOptions& options)
      : solid_(solid),
        options_(options),
        evaluator_(solid, {options.half_angle, options.min_quality},
                   {.fingertip_radius = options.finger_radius}),
        start_choice_(std::move(start)),
        goal_choice_(std::move(goal)),
        graph_(graph),
        geometry_(solid, graph) {}

  PlanResult Run() {
    RandomStream of_start(options_.seed, RandomUse::kStart);
    RandomStream of_goal(options_.seed, RandomUse::kGoal);
    Resolve(start_choice_, of_start);
    start_.grasp = start_choice_.grasp;
    if (goal_choice_.kind != Kind::kRandom) {
      Resolve(goal_choice_, of_goal);
      // Where there is nothing to do, the grasp need not be in a cell.
      if (IsGoalTheStart()) return FinishEmpty();
      start_.at = Locate(start_choice_);
      return PlanToGoal();
    }
    start_.at = Locate(start_choice_);
    return PlanToRandomGoal([&](bool last) {
      goal_pools_ = GoalPools(graph_.components(), CellsOf(start_.at));
      if (last) goal_pools_.erase(goal_pools_.begin());
      Resolve(goal_choice_, of_goal);
      return IsGoalTheStart() ? FinishEmpty() : PlanToGoal();
    });
  }

 private:
  PlanResult PlanToGoal() {
    goal_ = {goal_choice_.grasp, Locate(goal_choice_)};
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " focus cells");
    PolyhedronSequenceBuilder maker(geometry_, evaluator_, start_, goal_);
    const auto draft = FindCandidate(
        evaluator_, [&](const auto& banned) { return FindPath(banned); },
        [&](const auto& path, auto& banned) { return maker.Make(path, banned); },
        options_.deadline);
    if (draft) {
      return ResultOf(*draft, evaluator_, "polyhedron", kPolyhedronFingers, goal_choice_.grasp);
    }
    PlanResult result;
    result.status = PlanResult::Status::kNoSequence;
    result.message = NoSequenceMessage();
    return result;
  }

  [[nodiscard]] double same_point() const { return kSamePoint * solid_.diameter(); }

  [[nodiscard]] bool IsGoalTheStart() const {
    return AreSameGrasp(start_choice_.grasp, goal_choice_.grasp,
                        kPointTolerance * solid_.diameter());
  }

  /// Checks a given grasp, draws a random one.
  void Resolve(GraspChoice& choice, RandomStream& random) {
    if (choice.kind == Kind::kGiven) {
      CheckGivenGrasp(choice, {"polyhedron", kContacts, kContacts}, evaluator_.frame(),
                      options_.half_angle, same_point());
      CheckFingersFit(choice, solid_, options_.finger_radius);
      return;
    }
    if (choice.kind == Kind::kRandom) {
      const auto draw = [&](int cell) {
        options_.deadline.Check();
        const auto grasp = geometry_.Draw(cell, random);
        return grasp ? geometry_.GraspOf(*grasp) : Grasp();
      };
      const bool is_goal = !goal_pools_.empty();
      choice.grasp = DrawFromSets(choice, is_goal ? goal_pools_ : StartPools(graph_.vertex_count()),
                                  draw, evaluator_, random);
      return;
    }
    choice.grasp = DrawOnSurface(solid_, {kContacts, kContacts}, evaluator_, random, choice.name,
                                 [&] { options_.deadline.Check(); });
  }

  static std::set<int> CellsOf(const std::vector<FocusGrasp>& grasps) {
    std::set<int> cells;
    for (const FocusGrasp& grasp : grasps) cells.insert(grasp.cell);
    return cells;
  }

  std::vector<FocusGrasp> Locate(const GraspChoice& choice) {
    std::vector<FocusGrasp> at = geometry_.Locate(choice.grasp);
    if (!at.empty()) return at;
    if (graph_.vertex_count() == 0) {
      throw NoGrasp{choice.name +
                    ": force closure, but the body has no focus cell, as the planner polyhedron "
                    "needs them"};
    }
    throw NoGrasp{choice.name + ": force closure, but in none of the " +
                  std::to_string(graph_.vertex_count()) +
                  " focus cells: its four contacts are not concurrent, as the planner polyhedron "
                  "needs them"};
  }

  [[nodiscard]] std::vector<int> FindPath(const std::set<VertexPair>& banned) {
    const GraphWithout without(graph_, banned);
    const WithEnds graph(without, start_, goal_);
    std::vector<int> path = FindWidePath(graph, graph.start(), graph.goal(), [&](int vertex) {
      options_.deadline.Check();
      return geometry_.WidthOf(vertex);
    });
    if (path.empty()) return {};
    return {path.begin() + 1, path.end() - 1};
  }

  [[nodiscard]] PlanResult FinishEmpty() {
    const PolyhedronSequenceBuilder maker(geometry_, evaluator_, start_, goal_);
    return ResultOf(maker.MakeEmpty(), evaluator_, "polyhedron", kPolyhedronFingers,
                    goal_choice_.grasp);
  }

  [[nodiscard]] std::string NoSequenceMessage() const {
    const Components components = graph_.components();
    const auto size = [&](const PolyhedronSequenceBuilder::End& end) {
      std::set<int> reached;
      for (const FocusGrasp& at : end.at) reached.insert(components.of_vertex[at.cell]);
      int sum = 0;
      for (const int component : reached) sum += components.sizes[component];
      return std::to_string(sum);
    };
    return "no sequence of switches and aligns leads from start to goal: of " +
           std::to_string(graph_.vertex_count()) + " focus cells the start's component has " +
           size(start_) + ", the goal's " + size(goal_);
  }

  const Polyhedron& solid_;
  const PolyhedronPlanOptions& options_;
  GraspEvaluator evaluator_;
  GraspChoice start_choice_;
  GraspChoice goal_choice_;
  SamplingPools goal_pools_;  ///< that a random goal is drawn from
  PolyhedronGraph& graph_;
  FocusGeometry geometry_;
  PolyhedronSequenceBuilder::End start_;
  PolyhedronSequenceBuilder::End goal_;
};

}  // namespace

PlanResult PlanOnPolyhedron(const Polyhedron& solid, const GraspChoice& start,
                            const GraspChoice& goal, const PolyhedronPlanOptions& options) {
  try {
    CheckMemory(
        [&] { return EstimatePolyhedronGraph(solid, options.half_angle, options.spanning); },
        options.memory);
    options.progress("building the switching graph");
    PolyhedronGraph graph(solid, options.half_angle, options.spanning, options.deadline);
    return PlanOnPolyhedron(solid, graph, start, goal, options);
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  } catch (const TimeUp& time_up) {
    return ResultOf(time_up, "polyhedron");
  }
}

PlanResult PlanOnPolyhedron(const Polyhedron& solid, PolyhedronGraph& graph,
                            const GraspChoice& start, const GraspChoice& goal,
                            const PolyhedronPlanOptions& options) {
  if (!(options.min_quality >= 0)) throw std::invalid_argument("min_quality is negative");
  try {
    return PolyhedronPlanner(solid, graph, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  } catch (const TimeUp& time_up) {
    return ResultOf(time_up, "polyhedron");
  }
}

}  // namespace regrasp
