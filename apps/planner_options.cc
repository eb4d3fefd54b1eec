#include "apps/planner_options.h"

#include <algorithm>

#include "apps/help.h"
#include "apps/nearest_word.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/object/reading.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/build_roadmap.h"

namespace regrasp::apps {

namespace {

std::vector<std::string> NamesForUsers() {
  std::vector<std::string> names = {"auto"};
  for (const planning::Planner* planner : registry::AllPlanners()) names.push_back(planner->name());
  return names;
}

/// Spelled out rather than left to CLI11, so that the message says why a known name is refused.
std::string CheckPlanner(const std::string& name) {
  const std::vector<std::string> names = NamesForUsers();
  if (std::ranges::find(names, name) != names.end()) return {};
  return "the planner \"" + name + "\" does not exist in this version; there are " +
         registry::PlannerNames() + DidYouMean(name, names);
}

/// The planners, each with what it plans.
std::string PlannersText() {
  std::string text = "auto";
  for (const planning::Planner* planner : registry::AllPlanners()) {
    text += ", " + planner->name() + " (" + planner->traits().what + ")";
  }
  return text;
}

}  // namespace

void PlannerOptions::AddTo(CLI::App& app, const std::string& automatic) {
  BeginGroup(app, "Object and friction");
  app.add_option("--object", object,
                 "The object: a polygon (WKT) or a closed surface mesh (OBJ, OFF, PLY, STL, …)")
      ->type_name("FILE")
      ->required();
  AddScale(app, scale);
  friction.AddTo(app);
  BeginGroup(app, "Planner");
  std::string type;
  for (const std::string& name : NamesForUsers()) type += (type.empty() ? "" : "|") + name;
  app.add_option("--planner", planner,
                 "The planner: " + PlannersText() + " (default auto: " + automatic + ")")
      ->type_name(type)
      ->check(CheckPlanner);
  AddChoice<planning::Spanning>(
      app, "--spanning", spanning,
      {{"adaptive", planning::Spanning::kAdaptive}, {"uniform", planning::Spanning::kUniform}},
      "How wide cones of focus cells are: adaptive, as the normals allow, or uniform, all of the "
      "friction's half-angle; of polygon and polyhedron (default adaptive)");
  AddInteger(app, "--contacts", contacts, roadmap::kFewestClusters, roadmap::kMaxClusteredContacts,
             "Contact points of the roadmap: spread evenly over the surface, on a mesh at the "
             "centres of its facets (default 60, in clusters 1000)");
  AddInteger(app, "--clusters", clusters, roadmap::kFewestClusters, roadmap::kMostClusters,
             "Clusters that the roadmap sorts its contact points into: it looks at all grasps of "
             "their representatives only (default: 50 where there are more than " +
                 std::to_string(roadmap::kMaxRoadmapContacts) +
                 " contact points to choose or faces, otherwise none)");
  AddSeed(app, seed, "Seed of everything that is drawn at random (default 0)");
  app.add_flag(
      "--force", force,
      "Build a planner's graph also where it takes more than half of the memory; otherwise "
      "that is refused");
  AddNumber(app, "--time-limit", time_limit_s, NumberRange::Positive(),
            "Longest time from the program's start, seconds: after it reading, planning and "
            "building a graph give up; a plan then depends on the machine",
            "S");
  AddQuiet(app, quiet);
}

planning::PlanRequest PlannerOptions::RequestFor(const object::Object& of) const {
  planning::PlanRequest request;
  request.object = &of;
  request.object_name = object;
  request.criteria.half_angle = friction.required_half_angle();
  request.seed = seed;
  request.deadline = deadline();
  request.spanning = spanning;
  request.contact_points = contacts;
  request.clusters = clusters;
  return request;
}

Deadline PlannerOptions::deadline() const {
  return time_limit_s ? DeadlineAfter(begin, *time_limit_s) : Deadline();
}

object::ObjectFile PlannerOptions::ReadObjectFile() const {
  ProgressLine progress(quiet);
  return object::ReadObject(object, {progress.reporter(), deadline()});
}

const planning::Planner& PlannerOptions::PlannerFor(const planning::PlanRequest& request) const {
  const planning::Planner& found = registry::PlannerFor(planner, request);
  if (force) return found;
  if (const auto need = found.EstimateMemory(request)) {
    const std::string why = MemoryComplaint(*need, UsableMemory());
    if (!why.empty()) throw InputError(object + ": " + why + " (--force builds it all the same)");
  }
  return found;
}

}  // namespace regrasp::apps
