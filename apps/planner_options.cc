#include "apps/planner_options.h"

#include <limits>

#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/object/reading.h"

namespace regrasp {

namespace {

/// Spelled out rather than left to CLI11, so that the message says why a known name is refused.
std::string CheckPlanner(const std::string& name) {
  for (const char* known : {"auto", "polygon", "contour", "polyhedron", "roadmap", "general"}) {
    if (name == known) return {};
  }
  return "the planner \"" + name +
         "\" does not exist in this version; there are auto, polygon, contour, polyhedron, roadmap "
         "and general";
}

std::string CheckSpanning(const std::string& name) {
  if (name == "adaptive" || name == "uniform") return {};
  return "expected adaptive or uniform, found \"" + name + "\"";
}

}  // namespace

void PlannerOptions::AddTo(CLI::App& app, const AutomaticPlanner& automatic) {
  app.add_option("--object", object,
                 "The object: a polygon (WKT) or a closed surface mesh (OBJ, OFF, PLY, STL, …)")
      ->type_name("FILE")
      ->required();
  friction.AddTo(app);
  app.add_option(
         "--planner", planner,
         "auto, polygon, contour (2-finger grasps of the whole boundary), polyhedron "
         "(concurrent grasps), roadmap or general (any force-closure grasps, on any body, with "
         "switches and aligns) (default auto: in space " +
             automatic.in_space + "; in the plane " + automatic.in_plane + ")")
      ->type_name("NAME")
      ->check(CheckPlanner);
  app.add_option(
         "--spanning", spanning,
         "adaptive or uniform: cones of focus cells as wide as the normals allow, or all of "
         "the friction's half-angle; the roadmap has none (default adaptive)")
      ->type_name("NAME")
      ->check(CheckSpanning);
  AddInteger(app, "--contacts", contacts, kFewestClusters, kMaxClusteredContacts,
             "Contact points of the roadmap: spread evenly over the surface, on a mesh at the "
             "centres of its facets (default 60, in clusters 1000)");
  AddInteger(app, "--clusters", clusters, kFewestClusters, kMostClusters,
             "The roadmap sorts its contact points into so many clusters and looks at all grasps "
             "of their representatives only (default: 50 where there are more than " +
                 std::to_string(kMaxRoadmapContacts) +
                 " contact points to choose or faces, otherwise none)");
  AddSeed(app, seed, "Seed of everything that is drawn at random (default 0)");
  app.add_flag("--force", force,
               "Builds a planner's graph also where it would take more than half "
               "of the memory, which is refused otherwise");
  AddScale(app, scale);
  AddQuiet(app, quiet);
}

RoadmapOptions PlannerOptions::roadmap(const Polyhedron& solid) const {
  RoadmapOptions options;
  options.half_angle = friction.required_half_angle();
  const RoadmapSize size = ChooseRoadmapSize(solid, contacts, clusters);
  options.contacts = size.contacts;
  options.clusters = size.clusters;
  options.seed = seed;
  return options;
}

ObjectFile PlannerOptions::ReadObjectFile(const Deadline& deadline) const {
  ProgressLine progress(quiet);
  return ReadObject(object, {progress.reporter(), deadline});
}

double PlannerOptions::memory() const {
  return force ? std::numeric_limits<double>::infinity() : UsableMemory();
}

void PlannerOptions::CheckMemory(const MemoryNeed& need) const {
  const std::string why = MemoryComplaint(need, memory());
  if (!why.empty()) throw InputError(object + ": " + why + " (--force builds it all the same)");
}

Spanning PlannerOptions::spanning_value() const {
  return spanning == "uniform" ? Spanning::kUniform : Spanning::kAdaptive;
}

const Polygon& PolygonOf(const ObjectFile& file, const PlannerOptions& options) {
  const auto* polygon = dynamic_cast<const Polygon*>(file.object.get());
  if (polygon == nullptr) {
    throw InputError(options.object + ": a solid, and the planner " + options.planner +
                     " works on planar objects only");
  }
  return *polygon;
}

const Polyhedron& SolidOf(const ObjectFile& file, const PlannerOptions& options) {
  const auto* solid = dynamic_cast<const Polyhedron*>(file.object.get());
  if (solid == nullptr) {
    throw InputError(options.object + ": a planar object, and the planner " + options.planner +
                     " works on solids only");
  }
  return *solid;
}

}  // namespace regrasp
