// plan: finds a regrasp sequence from a start grasp to a goal grasp and writes a plan.

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <string>

#include "apps/output_files.h"
#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/certificate/align_certificate.h"
#include "planner/criteria/reach.h"
#include "planner/plan/plan_io.h"
#include "planner/registry/plan_auto.h"
#include "planner/registry/plan_spatial.h"
#include "planner/roadmap/roadmap_memory.h"
#include "planner/sets/contour/graph_memory.h"
#include "planner/sets/polygon/graph_memory.h"
#include "planner/sets/polyhedron/graph_memory.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "plan";

/// A day's work.
constexpr std::int64_t kMostEffort = 100'000'000'000;

/// Of planners whose need was checked before.
constexpr double kNoMemoryLimit = std::numeric_limits<double>::infinity();

/// Instead of a grasp file.
constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

bool IsRandom(const std::string& grasp) { return grasp == kRandom || grasp == kRandomAny; }

using ProgressReport = std::function<void(std::string_view)>;

struct PlanProgram {
  PlannerOptions common;
  std::string start;
  std::string goal;
  std::string output;
  double min_quality = RoadmapOptions().min_quality;
  double finger_radius = 0;  ///< 0: points
  std::string optimize;
  bool no_lazy = false;
  std::int64_t effort = GeneralPlanOptions::kDefaultEffort;
  std::optional<double> time_limit_s;
  const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  bool explain = false;

  void AddTo(CLI::App& app) {
    common.AddTo(app, {.in_plane = "contour where start and goal are 2-finger grasps and it joins "
                                   "them, polygon where that does, otherwise general",
                       .in_space = "polyhedron where start and goal are in its graph and joined, "
                                   "otherwise general; or roadmap where its options are given"});
    const std::string kinds =
        ": a grasp file, random (a grasp of the planner's own graph; under auto like random-any) "
        "or random-any (evenly over the surface)";
    app.add_option("--start", start, "Start grasp" + kinds)
        ->type_name("FILE|random|random-any")
        ->required();
    app.add_option("--goal", goal, "Goal grasp" + kinds)
        ->type_name("FILE|random|random-any")
        ->required();
    app.add_option("--output", output, "Where the plan goes; - is standard output")
        ->type_name("FILE")
        ->required();
    AddNumber(app, "--min-quality", min_quality, NumberRange::NotNegative(),
              "Quality that random grasps have at least, and the sequence's grasps where there is "
              "a way: the largest ball of wrenches resisted, normal forces summing to 1, torques "
              "over half the diameter (default 0.01)");
    AddNumber(app, "--finger-radius", finger_radius, NumberRange::Positive(),
              "Radius of the fingers, in the object file's own unit of length: contacts that a "
              "finger cannot come to straight along the normal, and grasps in which two fingers "
              "overlap, are avoided (default: fingers are points)")
        ->type_name("R");
    app.add_flag("--no-lazy", no_lazy,
                 "On a roadmap of clusters: no search among the grasps of all contact points where "
                 "the way over the representatives fails");
    app.add_option(
           "--optimize", optimize,
           "The planner general: steps (the fewest found, then margin; the default), margin "
           "(the weakest grasp's margin, with two steps more at most), travel (the fewest "
           "found, then the least way of the fingers). The planner contour: regions (every switch "
           "where the smaller of "
           "its two grasps' contact regions is largest; default: well inside both sets)")
        ->check(CLI::IsMember({"steps", "margin", "travel", "regions"}))
        ->type_name("steps|margin|travel|regions");
    AddGeneral(app);
  }

  void AddGeneral(CLI::App& app) {
    app.add_option("--effort", effort,
                   "The planner general: force-closure tests, some microseconds each, after which "
                   "it gives up (default " +
                       std::to_string(GeneralPlanOptions::kDefaultEffort) + ")")
        ->check(CLI::Range(std::int64_t{1}, kMostEffort))
        ->type_name("N");
    AddNumber(
        app, "--time-limit", time_limit_s, NumberRange::Positive(),
        "Seconds from the program's start after which reading and planning give up; the plan then "
        "depends on the machine")
        ->type_name("S");
    app.add_flag("--explain", explain,
                 "The planner general: where it finds no sequence, looks for the smallest friction "
                 "at which it finds one");
  }

  int Run() const;

 private:
  GraspChoice Choose(const std::string& option, const std::string& value,
                     const Object& object) const;
  PlanResult Find(const ObjectFile& object) const;
  PlanResult PlanOnSolid(const Polyhedron& solid, const ProgressReport& report) const;
  PlanResult PlanAnyGrasps(const Object& object, const ProgressReport& report) const;
  void CheckUsage() const;
  void CheckOutput() const;
  [[nodiscard]] bool AsksForRoadmap() const {
    return no_lazy || common.contacts.has_value() || common.clusters.has_value();
  }
  [[nodiscard]] Deadline deadline() const {
    return time_limit_s ? DeadlineAfter(begin, *time_limit_s) : Deadline();
  }
  [[nodiscard]] SwitchObjective contour_aim() const {
    return optimize == "regions" ? SwitchObjective::kRegion : SwitchObjective::kRoom;
  }
  PlanResult PlanInPlane(const Polygon& polygon, const ProgressReport& report) const;
  void PrintSummary(const PlanResult& result, double seconds) const;
};

GraspChoice PlanProgram::Choose(const std::string& option, const std::string& value,
                                const Object& object) const {
  using Kind = GraspChoice::Kind;
  if (!IsRandom(value)) return {Kind::kGiven, ReadGrasp(value, object), value};
  const bool any = value == kRandomAny || common.planner == "auto";
  return {any ? Kind::kRandomAny : Kind::kRandom, {}, option + " " + value};
}

PlanResult PlanProgram::Find(const ObjectFile& object) const {
  ProgressLine progress(common.quiet);
  const ProgressReport report = progress.reporter();
  const bool planar = object.object->dimension() == 2;
  PlanResult result;
  const bool automatic = common.planner == "auto" && !AsksForRoadmap();
  if (common.planner == "general" || automatic) {
    result = PlanAnyGrasps(*object.object, report);
  } else if (common.planner == "roadmap" || common.planner == "polyhedron" ||
             (common.planner == "auto" && !planar)) {
    result = PlanOnSolid(SolidOf(object, common), report);
  } else {
    result = PlanInPlane(PolygonOf(object, common), report);
  }
  progress.Clear();
  return result;
}

PlanResult PlanProgram::PlanOnSolid(const Polyhedron& solid, const ProgressReport& report) const {
  RoadmapOptions options = common.roadmap(solid);
  options.last_resort = !no_lazy;
  options.min_quality = min_quality;
  options.finger_radius = finger_radius;
  options.progress = report;
  const GraspChoice from = Choose("--start", start, solid);
  const GraspChoice to = Choose("--goal", goal, solid);
  options.deadline = deadline();
  if (common.planner == "auto") {
    options.memory = common.memory();
    return PlanSpatial(solid, from, to, common.spanning_value(), options);
  }
  if (common.planner == "roadmap") {
    common.CheckMemory(EstimateRoadmap(solid, options));
    return PlanOnRoadmap(solid, from, to, options);
  }
  common.CheckMemory(EstimatePolyhedronGraph(solid, options.half_angle, common.spanning_value()));
  return PlanOnPolyhedron(solid, from, to,
                          {options.half_angle, common.spanning_value(), options.seed, min_quality,
                           report, finger_radius, kNoMemoryLimit, deadline()});
}

PlanResult PlanProgram::PlanAnyGrasps(const Object& object, const ProgressReport& report) const {
  GeneralPlanOptions options;
  options.half_angle = common.friction.required_half_angle();
  options.seed = common.seed;
  options.min_quality = min_quality;
  options.effort = effort;
  options.finger_radius = finger_radius;
  options.deadline = deadline();
  options.explain = explain;
  options.progress = report;
  if (optimize == "margin") options.aim = Objective::kMargin;
  if (optimize == "travel") options.aim = Objective::kTravel;
  const GraspChoice from = Choose("--start", start, object);
  const GraspChoice to = Choose("--goal", goal, object);
  if (common.planner == "general") return PlanGeneral(object, from, to, options);
  return PlanAuto(object, from, to,
                  {options, common.spanning_value(), contour_aim(), common.memory()});
}

PlanResult PlanProgram::PlanInPlane(const Polygon& polygon, const ProgressReport& report) const {
  const GraspChoice from = Choose("--start", start, polygon);
  const GraspChoice to = Choose("--goal", goal, polygon);
  const double half_angle = common.friction.required_half_angle();
  const PolygonPlanOptions options = {
      half_angle, common.spanning_value(), common.seed,    min_quality,
      report,     finger_radius,           kNoMemoryLimit, deadline()};
  if (common.planner == "polygon") {
    common.CheckMemory(EstimatePolygonGraph(polygon, half_angle, options.spanning));
    return PlanOnPolygon(polygon, from, to, options);
  }
  common.CheckMemory(EstimateContourPlan(polygon, half_angle));
  return PlanOnContour(polygon, from, to,
                       {half_angle, common.seed, min_quality, contour_aim(), report, finger_radius,
                        kNoMemoryLimit, deadline()});
}

void PlanProgram::CheckUsage() const {
  const auto is = [&](const char* planner) {
    return common.planner == planner || common.planner == "auto";
  };
  if (no_lazy && !is("roadmap")) {
    throw InputError("--no-lazy: the planner " + common.planner +
                     " has no last resort; roadmap has");
  }
  if (common.planner == "general" && AsksForRoadmap()) {
    throw InputError("--contacts and --clusters: the planner general has none; roadmap has");
  }
  if (optimize == "regions" && !is("contour")) {
    throw InputError("--optimize regions: the planner " + common.planner +
                     " has no such regions; contour has");
  }
  const bool for_general = explain || (!optimize.empty() && optimize != "regions");
  if (for_general && !is("general")) {
    throw InputError((explain ? "--explain" : "--optimize " + optimize) + ": not for the planner " +
                     common.planner + "; for general");
  }
}

void PlanProgram::CheckOutput() const {
  if (output == "-") return;
  std::vector<NamedFile> inputs = {{"--object", common.object}};
  if (!IsRandom(start)) inputs.push_back({"--start", start});
  if (!IsRandom(goal)) inputs.push_back({"--goal", goal});
  OutputFiles outputs;
  outputs.Add("--output", output);
  CheckOutputsDiffer(inputs, outputs);
  CheckOutputsWritable(outputs);
}

int PlanProgram::Run() const {
  CheckUsage();
  CheckOutput();
  const ObjectFile object = common.ReadObjectFile(deadline());
  CheckFingerRadius(*object.object, finger_radius, "--finger-radius");
  PlanResult result = Find(object);
  if (!result.plan) {
    PrintMessage(kProgram, result.message);
    return kExitNegative;
  }
  result.plan->object_file = object.file;
  result.plan->object_sha256 = object.sha256;
  result.plan->scale = common.scale;
  AddCertificates(*object.object, *result.plan);
  const std::string text = FormatPlan(*result.plan);
  if (output == "-") {
    std::cout << text;
  } else {
    WriteFile(output, text);
  }
  for (const std::string& warning : result.warnings) PrintMessage(kProgram, "warning: " + warning);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  if (!common.quiet) PrintSummary(result, time.count());
  return kExitDone;
}

void PlanProgram::PrintSummary(const PlanResult& result, double seconds) const {
  const auto count = [&](const std::string& kind, const std::string& several) {
    const auto n = std::count_if(result.plan->steps.begin(), result.plan->steps.end(),
                                 [&](const Step& step) { return StepKind(step) == kind; });
    return std::to_string(n) + " " + (n == 1 ? kind : several);
  };
  const double given = Degrees(result.plan->half_angle);
  std::string planner = result.plan->planner;
  if (const auto& note = result.plan->roadmap) {
    planner += " of " + std::to_string(note->clusters) + " clusters (start: " + note->start +
               ", goal: " + note->goal + ")";
  }
  PrintMessage(kProgram, planner + ": " + count("switch", "switches") + ", " +
                             count("align", "aligns") +
                             "; the weakest grasp needs a friction half-angle of " +
                             FormatShort(given - Degrees(result.margin)) + "° of " +
                             FormatShort(given) + "°; " + FormatShort(seconds, 2) + " s");
  for (const std::string& note : result.notes) PrintMessage(kProgram, note);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds a regrasp sequence from a start grasp to a goal grasp and writes a plan.",
               kProgram);
  PlanProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
