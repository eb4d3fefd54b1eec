#include "planner/registry/registry.h"

#include <algorithm>

#include "planner/roadmap/roadmap_planner.h"
#include "planner/sets/contour/contour_planner.h"
#include "planner/sets/polygon/polygon_planner.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/tree/tree_planner.h"

namespace regrasp {

const std::vector<const Planner*>& AllPlanners() {
  static const TreePlanner tree;
  static const ContourPlanner contour;
  static const PolygonPlanner polygon;
  static const PolyhedronPlanner polyhedron;
  static const RoadmapPlanner roadmap;
  static const std::vector<const Planner*> all = {&tree, &contour, &polygon, &polyhedron, &roadmap};
  return all;
}

std::string PlannerNames() {
  std::string names = "auto";
  for (const Planner* planner : AllPlanners()) {
    names += (planner == AllPlanners().back() ? " and " : ", ") + planner->name();
  }
  return names;
}

const Planner* FindPlanner(const std::string& name) {
  const auto found = std::ranges::find(AllPlanners(), name, &Planner::name);
  return found == AllPlanners().end() ? nullptr : *found;
}

}  // namespace regrasp
