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

// This file alone determines the choice of `--planner auto`.

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
    throw InputError("planner " + planner->name() + ": registered twice");
  }
  Planners().push_back(planner.get());
  owned.push_back(std::move(planner));
}

std::string PlannerNames() {
  std::string names = "auto";
  for (const planning::Planner* planner : AllPlanners()) {
    names += ", " + planner->name();
  }
  return names;
}

const planning::Planner* FindPlanner(const std::string& name) {
  const auto found = std::ranges::find(AllPlanners(), name, &planning::Planner::name);
  return found == AllPlanners().end() ? nullptr : *found;
}

namespace {

const planning::Planner* FirstThatServes(const planning::PlanRequest& request) {
  const auto found = std::ranges::find_if(AllPlanners(), [&](const planning::Planner* planner) {
    return planning::WhyNotServed(*planner, request).empty();
  });
  return found == AllPlanners().end() ? nullptr : *found;
}

/// List the planners that support an option of a request, for objects of its dimension.
std::string ThoseThatHave(planning::PlanOption option, const planning::PlanRequest& request) {
  std::string names;
  for (const planning::Planner* planner : AllPlanners()) {
    if (!planner->ScopeIn(request.object->dimension())) continue;
    const auto& options = planner->traits().options;
    if (std::ranges::find(options, option) == options.end()) continue;
    names += (names.empty() ? "" : ", ") + planner->name();
  }
  return names.empty() ? "no planner" : names;
}

}  // namespace

const planning::Planner& ChoosePlanner(const planning::PlanRequest& request) {
  if (const planning::Planner* planner = FirstThatServes(request)) return *planner;
  std::string why = "no planner supports this combination for " +
                    std::string(request.object->dimension() == 2 ? "a planar object" : "a solid") +
                    ":";
  bool first = true;
  for (const planning::PlanOption option : planning::OptionsOf(request)) {
    why += (first ? " " : ", ") + planning::OptionName(option) + " (" +
           ThoseThatHave(option, request) + ")";
    first = false;
  }
  throw InputError(why);
}

const planning::Planner& PlannerFor(const std::string& name, const planning::PlanRequest& request) {
  if (name == "auto") return ChoosePlanner(request);
  const planning::Planner* planner = FindPlanner(name);
  if (planner == nullptr) {
    throw InputError("--planner: unknown planner \"" + name + "\", expected one of " +
                     PlannerNames());
  }
  const std::string why = planning::WhyNotServed(*planner, request);
  if (why.empty()) return *planner;
  const planning::Planner* other = FirstThatServes(request);
  throw InputError(why + (other == nullptr ? "" : "; help: use --planner " + other->name()));
}

}  // namespace regrasp::registry
