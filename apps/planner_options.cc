#include "apps/planner_options.h"

#include <limits>

#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/object/reading.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/build_roadmap.h"

namespace regrasp::apps {

namespace {

/// Spelled out rather than left to CLI11, so that the message says why a known name is refused.
std::string CheckPlanner(const std::string& name) {
  if (name == "auto" || registry::FindPlanner(name) != nullptr) return {};
  return "the planner \"" + name + "\" does not exist in this version; there are " +
         registry::PlannerNames();
}

/// The planners, each with what it plans.
std::string PlannersText() {
  std::string text = "auto";
  for (const planning::Planner* planner : registry::AllPlanners()) {
    text += ", " + planner->name() + " (" + planner->traits().what + ")";
  }
  return text;
}

std::string CheckSpanning(const std::string& name) {
  if (name == "adaptive" || name == "uniform") return {};
  return "expected adaptive or uniform, found \"" + name + "\"";
}

}  // namespace

void PlannerOptions::AddTo(CLI::App& app, const std::string& automatic) {
  app.add_option("--object", object,
                 "The object: a polygon (WKT) or a closed surface mesh (OBJ, OFF, PLY, STL, …)")
      ->type_name("FILE")
      ->required();
  friction.AddTo(app);
  app.add_option("--planner", planner, PlannersText() + " (default auto: " + automatic + ")")
      ->type_name("NAME")
      ->check(CheckPlanner);
  app.add_option(
         "--spanning", spanning,
         "adaptive or uniform: cones of focus cells as wide as the normals allow, or all of "
         "the friction's half-angle; of polygon and polyhedron (default adaptive)")
      ->type_name("NAME")
      ->check(CheckSpanning);
  AddInteger(app, "--contacts", contacts, roadmap::kFewestClusters, roadmap::kMaxClusteredContacts,
             "Contact points of the roadmap: spread evenly over the surface, on a mesh at the "
             "centres of its facets (default 60, in clusters 1000)");
  AddInteger(app, "--clusters", clusters, roadmap::kFewestClusters, roadmap::kMostClusters,
             "The roadmap sorts its contact points into so many clusters and looks at all grasps "
             "of their representatives only (default: 50 where there are more than " +
                 std::to_string(roadmap::kMaxRoadmapContacts) +
                 " contact points to choose or faces, otherwise none)");
  AddSeed(app, seed, "Seed of everything that is drawn at random (default 0)");
  app.add_flag("--force", force,
               "Builds a planner's graph also where it would take more than half "
               "of the memory, which is refused otherwise");
  AddScale(app, scale);
  AddQuiet(app, quiet);
}

planning::PlanRequest PlannerOptions::RequestFor(const object::Object& of) const {
  planning::PlanRequest request;
  request.object = &of;
  request.object_name = object;
  request.criteria.half_angle = friction.required_half_angle();
  request.seed = seed;
  request.spanning =
      spanning == "uniform" ? planning::Spanning::kUniform : planning::Spanning::kAdaptive;
  request.contact_points = contacts;
  request.clusters = clusters;
  return request;
}

object::ObjectFile PlannerOptions::ReadObjectFile(const Deadline& deadline) const {
  ProgressLine progress(quiet);
  return object::ReadObject(object, {progress.reporter(), deadline});
}

double PlannerOptions::memory() const {
  return force ? std::numeric_limits<double>::infinity() : UsableMemory();
}

void PlannerOptions::CheckMemory(const MemoryNeed& need) const {
  const std::string why = MemoryComplaint(need, memory());
  if (!why.empty()) throw InputError(object + ": " + why + " (--force builds it all the same)");
}

}  // namespace regrasp::apps
