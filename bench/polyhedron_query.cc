#include "bench/polyhedron_query.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/number.h"
#include "planner/planning/solve.h"
#include "planner/sets/polyhedron/polyhedron_model.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_graph.h"
#include "planner/sets/set_parameters.h"

namespace regrasp {

namespace {

using Kind = planning::GraspChoice::Kind;

constexpr double kMillisecondsPerSecond = 1e3;

/// Sampler of starts from all cells of a graph, and of goals from the component of a start.
class QueryMaker {
 public:
  QueryMaker(polyhedron::PolyhedronGraph& graph, polyhedron::PolyhedronModel& model)
      : graph_(graph), components_(graph.components()), model_(model) {}

  std::pair<planning::GraspChoice, planning::GraspChoice> Make(std::uint64_t seed) {
    RandomStream of_start(seed, RandomUse::kStart);
    RandomStream of_goal(seed, RandomUse::kGoal);
    const planning::GraspChoice start =
        Draw("start", sets::StartPools(graph_.vertex_count()), of_start);
    std::set<sets::SetIndex> cells;
    for (const auto& at : model_.Attach(start.grasp)) cells.insert(at.set);
    return {start, Draw("goal", sets::GoalPools(components_, cells), of_goal)};
  }

 private:
  planning::GraspChoice Draw(const std::string& name, const sets::SamplingPools& pools,
                             RandomStream& random) {
    const auto draw = [&](sets::SetIndex cell) {
      const auto grasp = model_.Draw(cell, random);
      return grasp ? model_.GraspOf(*grasp) : grasp::Grasp();
    };
    planning::GraspChoice choice{Kind::kGiven, {}, name};
    choice.grasp = sets::DrawFromSets(choice.name, pools, draw, model_.evaluator(), random);
    return choice;
  }

  polyhedron::PolyhedronGraph& graph_;
  search::Components components_;
  polyhedron::PolyhedronModel& model_;
};

}  // namespace

QueryTimes TimeQueries(const object::Polyhedron& solid, double degrees, planning::Spanning spanning,
                       int queries) {
  planning::PlanRequest request = {.object = &solid,
                                   .criteria = {.friction_angle = Radians(degrees)},
                                   .parameters = sets::SetParameters{.spanning = spanning}};
  polyhedron::PolyhedronGraph graph(solid, request.criteria.friction_angle, spanning);
  const polyhedron::PolyhedronPlanner planner(&graph);
  polyhedron::PolyhedronModel model(solid, graph, request);
  QueryMaker maker(graph, model);
  QueryTimes times;
  std::vector<double> milliseconds;
  int switches = 0;
  for (int seed = 1; seed <= queries; ++seed) {
    std::tie(request.start, request.goal) = maker.Make(seed);
    const auto begin = std::chrono::steady_clock::now();
    const planning::PlanResult result = planning::Solve(planner, request);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    milliseconds.push_back(kMillisecondsPerSecond * took.count());
    ++times.queries;
    if (!result.plan) {
      ++times.without_plan;
      continue;
    }
    if (!result.warnings.empty()) ++times.with_warning;
    switches +=
        static_cast<int>(std::ranges::count_if(result.plan->steps, [](const plan::Step& step) {
          return std::holds_alternative<plan::Switch>(step);
        }));
  }
  std::ranges::sort(milliseconds);
  times.mean_switches = static_cast<double>(switches) / queries;
  times.mean_ms = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0) / queries;
  times.median_ms = milliseconds[milliseconds.size() / 2];
  times.most_ms = milliseconds.back();
  return times;
}

}  // namespace regrasp
