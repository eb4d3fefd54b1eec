#include "apps/planner_options.h"

#include <algorithm>

#include "apps/help.h"
#include "apps/nearest_word.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/number.h"
#include "planner/object/given_points.h"
#include "planner/object/reading.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/set_parameters.h"

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
  repair.AddWithSwitch(app);
  AddNumber(app, "--patch", patch, NumberRange::NotNegative(),
            "Radius of the patch that a fingertip touches; in the object file's unit of length: "
            "fingers keep off places where the facet's normal is not the mean over the patch, and "
            "grasps hold with either (default: 2 % of the diameter with --repair, otherwise 0: "
            "facets are as they are)",
            "R");
  AddNumber(app, "--roughness", roughness_deg, {0, 45, false, true},
            "Degrees by which a contact's normal may differ from its patch's; with so much less "
            "friction is planned (default 5)",
            "DEG");
  app.add_flag("--allow-invented", allow_invented,
               "Fingers may stand on surface that a repair invented; otherwise planners keep off "
               "it, as nobody knows what is there");
  friction.AddTo(app);
  contact.AddTo(app, "hard");
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
  AddContacts(app);
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

void PlannerOptions::AddContacts(CLI::App& app) {
  const auto parse = [this](const std::string& text) {
    contacts_given = text == "given";
    if (contacts_given) {
      contacts.reset();
    } else {
      contacts = ParseInteger<int>("--contacts", text, roadmap::kFewestClusters,
                                   roadmap::kMaxClusteredContacts);
    }
  };
  app.add_option_function<std::string>(
         "--contacts", parse,
         "Contact points of the roadmap: so many spread evenly over the surface, on a mesh at the "
         "centres of its facets, or given, at points that the object's file gives (of a cloud its "
         "points, of a mesh its vertices) and nowhere else (default 60, in clusters 1000)")
      ->type_name("N|given");
}

std::optional<std::vector<Eigen::Vector3d>> PlannerOptions::ReadGivenPoints() const {
  if (!contacts_given) return std::nullopt;
  ProgressLine progress(quiet);
  object::Reading reading;
  reading.progress = progress.reporter();
  reading.deadline = deadline();
  return object::ReadGivenPoints(object, reading);
}

planning::PlanRequest PlannerOptions::RequestFor(const object::Object& of) const {
  planning::PlanRequest request;
  request.object = &of;
  request.object_name = object;
  request.criteria.half_angle = PlannedHalfAngle();
  request.hand.torsion = contact.torsion().value_or(0);
  request.seed = seed;
  request.deadline = deadline();
  request.parameters.Edit<sets::SetParameters>().spanning = spanning;
  auto& roadmap = request.parameters.Edit<roadmap::RoadmapParameters>();
  roadmap.contact_points = contacts;
  roadmap.clusters = clusters;
  return request;
}

std::optional<object::FeltPatch> PlannerOptions::patch_felt() const {
  if (patch ? *patch == 0 : !repair.wanted()) return std::nullopt;
  return object::FeltPatch{patch, Radians(roughness_deg)};
}

std::optional<double> PlannerOptions::PatchRadius(const object::Object& of) const {
  if (!patch_felt()) return std::nullopt;
  return patch.value_or(object::kUsualPatch * of.diameter());
}

void PlannerOptions::NotePlaces(plan::RoadmapNote& note) const {
  if (patch_felt()) note.roughness = patch_felt()->most_angle;
  note.allow_invented = allow_invented;
}

double PlannerOptions::PlannedHalfAngle() const {
  const double half_angle = friction.required_half_angle();
  if (!patch_felt()) return half_angle;
  // A cone about a facet's normal, narrower by the angle to the patch's, lies within the patch's.
  const double planned = half_angle - Radians(roughness_deg);
  if (planned > 0) return planned;
  throw InputError("--roughness: of the friction's half-angle, " +
                   FormatShort(Degrees(half_angle)) +
                   "°, nothing is left to plan with; ask for less "
                   "than that");
}

Deadline PlannerOptions::deadline() const {
  return time_limit_s ? DeadlineAfter(begin, *time_limit_s) : Deadline();
}

object::ObjectFile PlannerOptions::ReadObjectFile(const std::string& program) const {
  ProgressLine progress(quiet);
  object::Reading reading{progress.reporter(), deadline(), patch_felt(), allow_invented};
  reading.shells = repair.shells();
  reading.on_shells = [&](const std::string& text) {
    progress.Clear();
    if (!quiet) PrintMessage(program, object + ": " + text);
  };
  if (!repair.wanted()) {
    object::ObjectFile file = object::ReadObject(object, reading);
    if (patch && *patch > 0 && file.object->dimension() == 2) {
      throw InputError("--patch: " + object + " is a polygon; only solids have rough surfaces");
    }
    return file;
  }
  std::string text;
  object::ObjectFile repaired = ReadRepaired(object, repair.Get(), reading, &text);
  progress.Clear();
  if (!quiet) PrintMessage(program, object + ": " + text);
  return repaired;
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
