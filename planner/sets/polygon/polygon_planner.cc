#include "planner/sets/polygon/polygon_planner.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/graph_memory.h"
#include "planner/sets/polygon/polygon_model.h"
#include "planner/sets/set_planner.h"
#include "planner/sets/summarize_graph.h"

namespace regrasp::polygon {

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

PolygonGraph BuildGraph(const planning::PlanRequest& request) {
  return PolygonGraph(PolygonOf(request), request.criteria.half_angle, request.spanning,
                      request.deadline, request.progress);
}

std::string NameOf(GraspType type) {
  constexpr std::array kNames = {"concurrent", "two_finger", "parallel"};
  return kNames[static_cast<int>(type)];
}

/// The pairs of types that can switch, in the order of the graph file.
std::vector<std::pair<GraspType, GraspType>> JoinedTypes(planning::Spanning spanning) {
  using enum GraspType;
  std::vector<std::pair<GraspType, GraspType>> joined = {{kConcurrent, kConcurrent},
                                                         {kTwoFinger, kConcurrent},
                                                         {kParallel, kParallel},
                                                         {kTwoFinger, kParallel},
                                                         {kTwoFinger, kTwoFinger}};
  if (spanning == planning::Spanning::kAdaptive) joined.emplace_back(kConcurrent, kParallel);
  return joined;
}

}  // namespace

PolygonPlanner::PolygonPlanner()
    : planning::Planner(
          {.name = "polygon",
           .what = "concurrent, 2-finger and parallel grasps",
           .in_plane =
               planning::PlannerScope{hand::kFingersInPlane, {2, hand::kFingersInPlane}, {2, 3}},
           .options = {planning::PlanOption::kUniformSpanning}}) {}

std::optional<MemoryNeed> PolygonPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimatePolygonGraph(PolygonOf(request), request.criteria.half_angle, request.spanning);
}

planning::PlanResult PolygonPlanner::Plan(const planning::PlanRequest& request) const {
  const PolygonGraph graph = BuildGraph(request);
  PolygonModel model(PolygonOf(request), graph, request);
  return sets::PlanOverSets(model, request, name());
}

planning::GraphSummary PolygonPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const PolygonGraph graph = BuildGraph(request);
  planning::GraphSummary summary = sets::SummaryOf(graph, *request.object, name());
  for (const auto type : {GraspType::kConcurrent, GraspType::kTwoFinger, GraspType::kParallel}) {
    const GraspTypeCounts& counts = graph.counts(type);
    summary.types.push_back(
        {NameOf(type), counts.candidates, counts.combinations, counts.vertices, counts.components});
  }
  for (const auto& [a, b] : JoinedTypes(request.spanning)) {
    summary.edges.emplace_back(NameOf(a) + "-" + NameOf(b), graph.edge_count(a, b));
  }
  return summary;
}

}  // namespace regrasp::polygon
