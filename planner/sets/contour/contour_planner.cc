#include "planner/sets/contour/contour_planner.h"

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_model.h"
#include "planner/sets/contour/graph_memory.h"
#include "planner/sets/set_planner.h"

namespace regrasp::contour {

ContourPlanner::ContourPlanner()
    : planning::Planner({.name = "contour",
                         .what = "2-finger grasps of the whole boundary",
                         .in_plane = planning::PlannerScope{kContourFingers, {2, 2}, {2, 2}},
                         .options = {planning::PlanOption::kRegions}}) {}

std::optional<MemoryNeed> ContourPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimateContourPlan(dynamic_cast<const object::Polygon&>(*request.object),
                             request.criteria.half_angle);
}

planning::PlanResult ContourPlanner::Plan(const planning::PlanRequest& request) const {
  const auto& polygon = dynamic_cast<const object::Polygon&>(*request.object);
  request.progress("building the switching graph");
  const ContourGraph graph(polygon, request.criteria.half_angle, request.deadline);
  ContourModel model(graph, request);
  return PlanOverSets(model, request, name());
}

}  // namespace regrasp::contour
