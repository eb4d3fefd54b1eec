// plan: finds a regrasp sequence from a start grasp to a goal grasp and writes a plan.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>

#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/angle.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/plan_io.h"
#include "planner/polygon/plan_polygon.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "plan";

struct PlanProgram {
  PlannerOptions common;
  std::string start;
  std::string goal;
  std::string output;
  double min_quality = RoadmapOptions().min_quality;

  void AddTo(CLI::App& app) {
    common.AddTo(app);
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
  }

  int Run() const;

 private:
  GraspChoice Choose(const std::string& option, const std::string& value,
                     const Object& object) const;
  PlanResult Find(const ObjectFile& object) const;
  void PrintSummary(const PlanResult& result, double seconds) const;
};

GraspChoice PlanProgram::Choose(const std::string& option, const std::string& value,
                                const Object& object) const {
  using Kind = GraspChoice::Kind;
  const bool any = value == "random-any" || (value == "random" && common.planner == "auto");
  if (any) return {Kind::kRandomAny, {}, option + " " + value};
  if (value == "random") return {Kind::kRandom, {}, option + " " + value};
  return {Kind::kGiven, ReadGrasp(value, object), value};
}

PlanResult PlanProgram::Find(const ObjectFile& object) const {
  ProgressLine progress(common.quiet);
  const auto report = [&](std::string_view text) { progress.Report(text); };
  PlanResult result;
  if (common.PlannerFor(object) == "polygon") {
    const Polygon& polygon = PolygonOf(object, common.object);
    const GraspChoice start_choice = Choose("--start", start, polygon);
    const GraspChoice goal_choice = Choose("--goal", goal, polygon);
    const PolygonPlanOptions options = {common.friction.required_half_angle(),
                                        common.spanning_value(), common.seed, min_quality, report};
    result = PlanOnPolygon(polygon, start_choice, goal_choice, options);
  } else {
    const Polyhedron& solid = SolidOf(object, common.object);
    RoadmapOptions options = common.roadmap();
    options.min_quality = min_quality;
    options.progress = report;
    result = PlanOnRoadmap(solid, Choose("--start", start, solid), Choose("--goal", goal, solid),
                           options);
  }
  progress.Clear();
  return result;
}

int PlanProgram::Run() const {
  const auto begin = std::chrono::steady_clock::now();
  const ObjectFile object = ReadObject(common.object);
  PlanResult result = Find(object);
  if (!result.plan) {
    PrintMessage(kProgram, result.message);
    return kExitNegative;
  }
  result.plan->object_file = object.file;
  result.plan->object_sha256 = object.sha256;
  result.plan->scale = common.scale;
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
  PrintMessage(kProgram, count("switch", "switches") + ", " + count("align", "aligns") +
                             "; the weakest grasp needs a friction half-angle of " +
                             FormatShort(given - Degrees(result.margin)) + "° of " +
                             FormatShort(given) + "°; " + FormatShort(seconds, 2) + " s");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds a regrasp sequence from a start grasp to a goal grasp and writes a plan.",
               kProgram);
  PlanProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
