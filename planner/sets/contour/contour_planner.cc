#include "planner/sets/contour/contour_planner.h"

#include <iterator>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_model.h"
#include "planner/sets/contour/graph_memory.h"
#include "planner/sets/set_planner.h"
#include "planner/sets/summarize_graph.h"

namespace regrasp::contour {

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

ContourGraph BuildGraph(const planning::PlanRequest& request) {
  request.progress("building the switching graph");
  return ContourGraph(PolygonOf(request), request.criteria.half_angle, request.deadline,
                      request.progress);
}

}  // namespace

ContourPlanner::ContourPlanner()
    : planning::Planner({.name = "contour",
                         .what = "2-finger grasps of the whole boundary",
                         .in_plane = planning::PlannerScope{3, {2, 2}, {2, 2}},
                         .options = {planning::PlanOption::kRegions}}) {}

std::optional<MemoryNeed> ContourPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  // A graph alone takes less than planning on it.
  const auto estimate = request.graph ? EstimateContourGraph : EstimateContourPlan;
  return estimate(PolygonOf(request), request.criteria.half_angle);
}

planning::PlanResult ContourPlanner::Plan(const planning::PlanRequest& request) const {
  const ContourGraph graph = BuildGraph(request);
  ContourModel model(graph, request);
  return sets::PlanOverSets(model, request, name());
}

planning::GraphSummary ContourPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const ContourGraph graph = BuildGraph(request);
  planning::GraphSummary summary = sets::SummaryOf(graph, *request.object, name());
  summary.edges = {{"two_finger-two_finger", std::ssize(graph.switches())}};
  summary.types = {{"two_finger", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  return summary;
}

}  // namespace regrasp::contour
