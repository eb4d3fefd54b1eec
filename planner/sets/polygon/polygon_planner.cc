#include "planner/sets/polygon/polygon_planner.h"

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/graph_memory.h"
#include "planner/sets/polygon/polygon_model.h"
#include "planner/sets/set_planner.h"

namespace regrasp::polygon {

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

}  // namespace

PolygonPlanner::PolygonPlanner()
    : planning::Planner(
          {.name = "polygon",
           .what = "concurrent, 2-finger and parallel grasps",
           .in_plane = planning::PlannerScope{kPolygonFingers, {2, kPolygonFingers}, {2, 3}},
           .options = {planning::PlanOption::kUniformSpanning}}) {}

std::optional<MemoryNeed> PolygonPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimatePolygonGraph(PolygonOf(request), request.criteria.half_angle, request.spanning);
}

planning::PlanResult PolygonPlanner::Plan(const planning::PlanRequest& request) const {
  request.progress("building the switching graph");
  const PolygonGraph graph(PolygonOf(request), request.criteria.half_angle, request.spanning,
                           request.deadline);
  PolygonModel model(PolygonOf(request), graph, request.deadline);
  return PlanOverSets(model, request, name());
}

}  // namespace regrasp::polygon
