#include "apps/planner_options.h"

#include <algorithm>

#include "apps/help.h"
#include "apps/list_option.h"
#include "apps/options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/gait/request.h"
#include "planner/object/object.h"
#include "planner/object/read_object.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/set_parameters.h"
#include "planner/tree/tree_planner.h"

namespace regrasp::apps {

namespace {

constexpr double kMostRoughness_deg = 45;

/// Largest search budget, hours of search.
constexpr std::int64_t kLargestBudget = 100'000'000'000;

/// Maximum number of queries.
/// More queries take minutes on objects with many failing queries.
constexpr int kMostQueries = 100'000;
/// More focus points take minutes.
constexpr int kMostSamples = 10'000'000;

std::vector<std::string> NamesForUsers() {
  std::vector<std::string> names = {"auto"};
  for (const planning::Planner* planner : registry::AllPlanners()) names.push_back(planner->name());
  return names;
}

/// Check the name of a planner.
/// @throws CLI::ValidationError  if there is no planner of this name.
void CheckPlanner(const std::string& option, const std::string& name) {
  const std::vector<std::string> names = NamesForUsers();
  if (std::ranges::find(names, name) != names.end()) return;
  throw CLI::ValidationError(option, "not found, expected one of " + registry::PlannerNames() +
                                         ", found \"" + name + "\"" + SimilarWord(name, names));
}

/// Return one line per planner.
/// Example: "general: any force-closure grasps, on any object".
std::string PlannersText() {
  std::string text;
  for (const planning::Planner* planner : registry::AllPlanners()) {
    text += (text.empty() ? "" : "\n") + planner->name() + ": " + planner->traits().what;
  }
  return text;
}

std::string PlannerHelp(PlannerOptions::Purpose purpose) {
  const bool plans = purpose == PlannerOptions::Purpose::kPlan;
  return std::string("Planner and its settings. auto is ") +
         (plans ? "general" : "polygon in the plane and roadmap in space") +
         " unless another option needs a different planner [default: auto]\n" + PlannersText() +
         "\nspanning=adaptive|uniform (polygon, polyhedron): opening angle of focus cells, as "
         "large "
         "as the normals permit or the friction angle [default: adaptive]\n"
         "points=N|given (roadmap): number of contact points, or the points of the object file "
         "[default: 60, with clusters 1000]\n"
         "clusters=N (roadmap): number of clusters of contact points [default: 50 for more than " +
         std::to_string(roadmap::kMaxRoadmapContacts) +
         " points, otherwise none]\n"
         "fallback=yes|no (roadmap): search all contact points if clusters do not connect start "
         "and "
         "goal [default: yes]\n" +
         (plans
              ? "budget=N (general, gait): search budget in force-closure tests [default: " +
                    std::to_string(tree::TreePlanner::kDefaultTests) +
                    "] or expanded grasps [default: " + std::to_string(gait::kDefaultExpanded) + "]"
              : "queries=N (roadmap with clusters): also answer N random queries between "
                "force-closure grasps\n"
                "sampling=N (polyhedron): find focus cells with N random focus points in a box "
                "around all cells\n"
                "compare (polyhedron): also print which share of the graph the sampling finds");
}

}  // namespace

void PlannerOptions::AddTo(CLI::App& app, Purpose purpose) {
  BeginGroup(app, "Input");
  app.add_option("--object", object,
                 "Object file. A polygon (WKT) or a closed surface mesh (OBJ, OFF, PLY, STL, …)")
      ->type_name("FILE")
      ->required();
  AddScale(app, scale);
  repair.AddWithSwitch(app);
  ListOption("--patch")
      .Values("a radius", {NumberParser(patch, NumberRange::NotNegative())})
      .Key("roughness", NumberParser(roughness_deg, {0, kMostRoughness_deg, false, true}))
      .AddTo(app, "R[,roughness=DEG]",
             "Radius of the contact patch, object units. Planners avoid places whose normal "
             "differs from the mean normal of the patch. Grasps are force closure with either "
             "normal [default: 2 % of the diameter with --repair, otherwise 0]\n"
             "roughness=DEG: largest difference, which reduces the friction angle [default: 5]");
  BeginGroup(app, "Friction and contact");
  friction.AddTo(app);
  if (purpose == Purpose::kPlan) contact.AddTo(app, "0");
  BeginGroup(app, "Planner");
  AddPlanner(app, purpose);
  AddSeed(app, seed, "Random seed [default: 0]");
  AddNumber(app, "--time-limit", time_limit_s, NumberRange::Positive(),
            "Time limit in seconds from the start of the program. Reading, planning and graph "
            "construction stop then, so plans depend on the machine",
            "S");
  ListOption("--allow")
      .Word("filled", [this] { allow_filled = true; })
      .Word("large-graph", [this] { force = true; })
      .AddTo(app, "WORD,…",
             "Exceptions to permit.\nfilled: contacts on surface that a repair filled in\n"
             "large-graph: a graph that needs more than half of the memory");
  AddQuiet(app, quiet);
}

void PlannerOptions::AddPlanner(CLI::App& app, Purpose purpose) {
  std::string type;
  for (const std::string& name : NamesForUsers()) type += (type.empty() ? "" : "|") + name;
  ListOption list("--planner");
  list.Values("a planner's name", {[this](const std::string& option, const std::string& name) {
                CheckPlanner(option, name);
                planner = name;
              }});
  list.Key("spanning",
           ChoiceParser<planning::Spanning>(spanning, {{"adaptive", planning::Spanning::kAdaptive},
                                                       {"uniform", planning::Spanning::kUniform}}));
  list.Key("points", [this](const std::string& name, const std::string& text) {
    contacts_given = text == "given";
    if (contacts_given) return;
    contacts =
        ParseInteger<int>(name, text, roadmap::kFewestClusters, roadmap::kMaxClusteredContacts);
  });
  list.Key("clusters", IntegerParser(clusters, roadmap::kFewestClusters, roadmap::kMostClusters));
  list.Key("fallback", ChoiceParser<bool>(fallback, {{"yes", true}, {"no", false}}));
  if (purpose == Purpose::kPlan) {
    list.Key("budget", IntegerParser(budget, std::int64_t{1}, kLargestBudget));
  } else {
    list.Key("queries", IntegerParser(queries, 1, kMostQueries));
    list.Key("sampling", IntegerParser(focus_points, 1, kMostSamples));
    list.Word("compare", [this] { compare = true; });
  }
  list.AddTo(app, type + "[,KEY=VALUE,…]", PlannerHelp(purpose));
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
  request.criteria.friction_angle = PlannedFrictionAngle();
  request.hand.torsion = contact.torsion().value_or(0);
  criteria::CheckTorsion(of, request.hand.torsion, "--torsion");
  request.seed = seed;
  request.deadline = deadline();
  request.parameters.Edit<sets::SetParameters>().spanning = spanning;
  auto& roadmap = request.parameters.Edit<roadmap::RoadmapParameters>();
  if (!contacts_given) roadmap.contact_points = contacts;
  roadmap.clusters = clusters;
  roadmap.last_resort = fallback;
  request.parameters.Edit<planning::SearchParameters>().budget = budget;
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
  note.allow_filled = allow_filled;
}

double PlannerOptions::PlannedFrictionAngle() const {
  const double friction_angle = friction.required_friction_angle();
  if (!patch_felt()) return friction_angle;
  // The friction cone about a triangle's normal is narrowed by the angle to the normal of the
  // contact patch. It is then inside the friction cone about the normal of the contact patch.
  const double planned = friction_angle - Radians(roughness_deg);
  if (planned > 0) return planned;
  throw InputError("--patch roughness: must be less than the friction angle, " +
                   FormatShort(Degrees(friction_angle)) + "°, found " + FormatShort(roughness_deg) +
                   "°");
}

Deadline PlannerOptions::deadline() const {
  return time_limit_s ? DeadlineAfter(begin, *time_limit_s) : Deadline();
}

object::ObjectFile PlannerOptions::ReadObjectFile(const std::string& program) const {
  ProgressLine progress(quiet);
  object::Reading reading{progress.reporter(), deadline(), patch_felt(), allow_filled};
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
    if (!why.empty()) {
      throw InputError(object + ": " + why + "; help: build it anyway with --allow large-graph");
    }
  }
  return found;
}

}  // namespace regrasp::apps
