#include "planner/registry/registry.h"

#include <algorithm>
#include <utility>

#include "planner/base/error.h"
#include "planner/gait/gait_planner.h"
#include "planner/roadmap/roadmap_planner.h"
#include "planner/sets/contour/contour_planner.h"
#include "planner/sets/polygon/polygon_planner.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/tree/tree_planner.h"

namespace regrasp::registry {

namespace {

std::vector<const planning::Planner*>& Planners() {
  static const tree::TreePlanner tree;
  static const contour::ContourPlanner contour;
  static const polygon::PolygonPlanner polygon;
  static const polyhedron::PolyhedronPlanner polyhedron;
  static const roadmap::RoadmapPlanner roadmap;
  static const gait::GaitPlanner gait;
  static std::vector<const planning::Planner*> all = {&tree,    &polygon,    &contour,
                                                      &roadmap, &polyhedron, &gait};
  return all;
}

}  // namespace

const std::vector<const planning::Planner*>& AllPlanners() { return Planners(); }

void RegisterPlanner(std::unique_ptr<const planning::Planner> planner) {
  static std::vector<std::unique_ptr<const planning::Planner>> owned;
  if (planner->name() == "auto" || FindPlanner(planner->name()) != nullptr) {
    throw InputError("planner " + planner->name() + " is registered already");
  }
  Planners().push_back(planner.get());
  owned.push_back(std::move(planner));
}

std::string PlannerNames() {
  std::string names = "auto";
  for (const planning::Planner* planner : AllPlanners()) {
    names += (planner == AllPlanners().back() ? " and " : ", ") + planner->name();
  }
  return names;
}

const planning::Planner* FindPlanner(const std::string& name) {
  const auto found = std::ranges::find(AllPlanners(), name, &planning::Planner::name);
  return found == AllPlanners().end() ? nullptr : *found;
}

}  // namespace regrasp::registry
