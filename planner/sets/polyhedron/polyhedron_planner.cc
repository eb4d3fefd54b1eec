#include "planner/sets/polyhedron/polyhedron_planner.h"

#include "planner/base/memory.h"
#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/graph_memory.h"
#include "planner/sets/polyhedron/polyhedron_model.h"
#include "planner/sets/set_planner.h"

namespace regrasp::polyhedron {

PolyhedronPlanner::PolyhedronPlanner(PolyhedronGraph* graph)
    : planning::Planner({.name = "polyhedron",
                         .what = "concurrent grasps of four faces",
                         .in_space = planning::PlannerScope{kPolyhedronFingers, {4, 4}, {4, 4}},
                         .options = {planning::PlanOption::kUniformSpanning}}),
      graph_(graph) {}

std::optional<MemoryNeed> PolyhedronPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*request.object);
  return EstimatePolyhedronGraph(solid, request.criteria.half_angle, request.spanning);
}

planning::PlanResult PolyhedronPlanner::Plan(const planning::PlanRequest& request) const {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*request.object);
  std::optional<PolyhedronGraph> own;
  if (graph_ == nullptr) {
    request.progress("building the switching graph");
    own.emplace(solid, request.criteria.half_angle, request.spanning, request.deadline);
  }
  PolyhedronModel model(solid, own ? *own : *graph_);
  return PlanOverSets(model, request, name());
}

}  // namespace regrasp::polyhedron
