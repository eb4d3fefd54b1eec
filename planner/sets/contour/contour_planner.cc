#include "planner/sets/contour/contour_planner.h"

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_model.h"
#include "planner/sets/contour/graph_memory.h"
#include "planner/sets/set_planner.h"

namespace regrasp::contour {

ContourPlanner::ContourPlanner()
    : Planner({.name = "contour",
               .what = "2-finger grasps of the whole boundary",
               .in_plane = PlannerScope{kContourFingers, {2, 2}, {2, 2}},
               .options = {PlanOption::kRegions}}) {}

std::optional<MemoryNeed> ContourPlanner::EstimateMemory(const PlanRequest& request) const {
  return EstimateContourPlan(dynamic_cast<const Polygon&>(*request.object),
                             request.criteria.half_angle);
}

PlanResult ContourPlanner::Plan(const PlanRequest& request) const {
  const auto& polygon = dynamic_cast<const Polygon&>(*request.object);
  request.progress("building the switching graph");
  const ContourGraph graph(polygon, request.criteria.half_angle, request.deadline);
  ContourModel model(graph, request);
  return PlanOverSets(model, request, name());
}

}  // namespace regrasp::contour
