#include "apps/plan_program.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <thread>

#include "apps/help.h"
#include "apps/nearest_word.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/certificate/align_certificate.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/request.h"
#include "planner/plan/grasp_io.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/tree/tree_planner.h"
#include "sim/actuation/simulate_execution.h"

namespace regrasp::apps {

namespace {

/// A day's work.
constexpr std::int64_t kMostEffort = 100'000'000'000;

/// Instead of a grasp file.
constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

constexpr int kMostJobs = 1024;

/// Of a plan that a planner found and `validate` would fail.
std::string CheckerComplaint(const plan::PlanCheck& check) {
  const auto failed = std::ranges::find_if(
      check.steps, [](const plan::StepCheck& step) { return step.reason != plan::Reason::kNone; });
  return "the checker fails this plan in step " + std::to_string(failed->index) + ", " +
         failed->kind + ": " + failed->detail;
}

}  // namespace

bool PlanEnd::is_random() const {
  return text.empty() && (value == kRandom || value == kRandomAny);
}

PlanProgram::PlanProgram()
    : jobs(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostJobs)) {}

void PlanProgram::AddTo(CLI::App& app) {
  common.AddTo(app, "general, unless an option asks for what only another has");
  BeginGroup(app, "Start, goal and result");
  AddEnds(app);
  BeginGroup(app, "What the sequence is like");
  AddNumber(app, "--min-quality", min_quality, NumberRange::NotNegative(),
            "Quality that random grasps have at least; the sequence prefers such grasps and a "
            "warning says where it must go below: the largest ball of wrenches resisted, normal "
            "forces summing to 1, torques over half the diameter (default 0.01)");
  AddNumber(app, "--finger-radius", finger_radius, NumberRange::Positive(),
            "Radius of the fingers, in the object file's own unit of length: contacts that a "
            "finger cannot come to straight along the normal, and grasps in which two fingers "
            "overlap, are avoided (default: fingers are points)",
            "R");
  AddSearch(app);
  hand.AddTo(app);
  BeginGroup(app, "Many plans");
  AddBatch(app);
  app.footer(
      "  plan --object cube.obj --friction-angle 20 --start start.json --goal goal.json \\\n"
      "       --output plan.json\n"
      "  plan --object part.stl --scale 0.001 --mu 0.5 --start random --goal random --seed 7 \\\n"
      "       --output - | validate --object part.stl --plan -\n");
}

void PlanProgram::AddEnds(CLI::App& app) {
  const std::string kinds =
      "; needed where no --hand is given, which takes files only: a grasp file, random (a grasp of "
      "the planner's own "
      "graph; under auto like random-any) "
      "or random-any (evenly over the surface)";
  app.add_option("--start", start.value, "Start grasp" + kinds)
      ->type_name("FILE|random|random-any");
  app.add_option("--goal", goal.value, "Goal grasp" + kinds)->type_name("FILE|random|random-any");
  app.add_option("--output", output, "Where the plan goes; - is standard output")
      ->type_name("FILE")
      ->required();
}

void PlanProgram::AddSearch(CLI::App& app) {
  app.add_flag("--no-lazy", no_lazy,
               "No search beyond the representatives on a roadmap of clusters: none among the "
               "grasps of all contact points where they do not join start and goal");
  AddChoice<planning::Objective>(
      app, "--optimize", objective,
      {{"steps", planning::Objective::kSteps},
       {"margin", planning::Objective::kMargin},
       {"travel", planning::Objective::kTravel},
       {"regions", planning::Objective::kRegions}},
      "What makes a sequence good: with the planner general steps (the fewest found, then margin; "
      "the default), margin (the weakest grasp's margin, with two steps more at most), travel (the "
      "fewest found, then the least travel of the fingers); with the planner contour regions "
      "(every switch where the smaller of its two grasps' contact regions is largest; default: "
      "well inside both sets); with --hand margin (of the plans found that the hand's motors carry "
      "out the one with the largest share of the replay's limits to spare; default: the first)");
  AddInteger(
      app, "--effort", effort, std::int64_t{1}, kMostEffort,
      "When to give up; the planner general after so many force-closure tests, each of some "
      "microseconds (default " +
          std::to_string(tree::TreePlanner::kDefaultTests) +
          "), with --hand after so many grasps searched, each of some milliseconds (default " +
          std::to_string(gait::kDefaultExpanded) + ")");
  app.add_flag(
      "--explain", explain,
      "Look for what would be enough where no sequence is found; the smallest friction (of "
      "the planner general), with --hand also the size of the object and a tilt of the "
      "palm, for as long again as --time-limit says");
}

void PlanProgram::AddBatch(CLI::App& app) {
  app.add_option(
         "--batch", batch,
         "File of queries, JSON Lines, each of which gets a plan; what a query does not say the "
         "other options do, and --object is a folder or the object of all. --output gets a "
         "line for each, in their order: a plan, or why there is none. A run that was "
         "stopped goes on where it was")
      ->type_name("FILE");
  app.add_option("--shard", shard, "Part I of N of the queries alone; merge joins the results")
      ->type_name("I/N");
  AddInteger(app, "--jobs", jobs, 1, kMostJobs,
             "Queries of --batch planned at a time, or with --hand searches made (default: one a "
             "processor); without --time-limit no plan depends on it");
  app.add_flag("--fresh", fresh,
               "Throw away what an earlier run with --batch and the same --output left");
}

planning::GraspChoice PlanProgram::Choose(const PlanEnd& end, const object::Object& object) const {
  using Kind = planning::GraspChoice::Kind;
  if (!end.text.empty()) {
    return {Kind::kGiven, plan::ParseGrasp(end.text, end.name, object), end.name};
  }
  const std::string& value = end.value;
  // No such file, and nearly one of the words.
  if (!end.is_random() && !std::filesystem::exists(value)) {
    const std::string meant = DidYouMean(value, {kRandom, kRandomAny});
    if (!meant.empty()) throw InputError(end.option + ": there is no file " + value + meant);
  }
  if (!end.is_random()) return {Kind::kGiven, plan::ReadGrasp(value, object), value};
  const bool any = value == kRandomAny || common.planner == "auto";
  return {any ? Kind::kRandomAny : Kind::kRandom, {}, end.option + " " + value};
}

planning::PlanRequest PlanProgram::RequestFor(const object::Object& object) const {
  planning::PlanRequest request = common.RequestFor(object);
  request.hand.fingertip_radius = finger_radius;
  request.criteria.min_quality = min_quality;
  request.objective = objective;
  request.parameters.Edit<roadmap::RoadmapParameters>().last_resort = !no_lazy;
  request.parameters.Edit<planning::SearchParameters>() = {.budget = effort, .explain = explain};
  if (batch.empty()) request.jobs = jobs;  // else there are as many processes
  return request;
}

planning::PlanResult PlanProgram::Find(const object::ObjectFile& object,
                                       const GivenPoints& given) const {
  planning::PlanRequest request = RequestFor(*object.object);
  if (given) request.given_points = &*given;
  if (hand_file) {
    if (object.object->dimension() != 3) {
      throw InputError("--hand: hands hold solids, and no planar objects");
    }
    planning::InHandTask task{.hand = &hand_file->hand, .scale = common.scale};
    task.simulate = sim::ExecutionSimulator(
        *hand_file, dynamic_cast<const object::Polyhedron&>(*object.object));
    hand.AskFor(task);
    gait::AskInHand(task, request);
  }
  const planning::Planner& planner = common.PlannerFor(request);
  if (start.given()) request.start = Choose(start, *object.object);
  if (goal.given()) request.goal = Choose(goal, *object.object);
  ProgressLine progress(common.quiet);
  std::once_flag begun;
  request.progress = [&](std::string_view text) {
    std::call_once(begun, [&] {
      progress.Clear();
      on_search();
    });
    progress.Report(text);
  };
  planning::PlanResult result = planning::Solve(planner, request);
  progress.Clear();
  return result;
}

void PlanProgram::CheckEnds() const {
  for (const PlanEnd& end : {start, goal}) {
    if (hand.given() && end.is_random()) {
      throw InputError(end.option +
                       ": with --hand a grasp file, or nothing, as the program "
                       "chooses a grasp that the hand reaches; found " +
                       end.value);
    }
    // Without a hand a plan is from a grasp to a grasp; a hand chooses those that are not given.
    if (!hand.given() && !end.given()) throw InputError(end.option + " is required");
  }
  hand.Check(start.value + start.text, goal.value + goal.text);
}

void PlanProgram::ReadHand() {
  if (!hand.given()) return;
  planning::InHandTask task;
  hand.AskFor(task);  // before any file is read
  hand_file = std::make_shared<const kinematics::HandFile>(kinematics::ReadHandFile(hand.hand));
}

FinishedPlan PlanProgram::Plan(const object::ObjectFile& object, const GivenPoints& given) const {
  FinishedPlan finished{Find(object, given), {}};
  planning::PlanResult& result = finished.result;
  if (!result.plan) return finished;
  if (result.plan->roadmap) common.NotePlaces(*result.plan->roadmap);
  finished.check = certificate::FinishPlan(object,
                                           {.half_angle = common.friction.required_half_angle(),
                                            .scale = common.scale,
                                            .shells = common.repair.shells(),
                                            .patch_radius = common.PatchRadius(*object.object),
                                            .given_points = given ? &*given : nullptr},
                                           *result.plan);
  if (!finished.check.passed()) result.warnings.push_back(CheckerComplaint(finished.check));
  if (hand_file) {
    for (const std::string& warning : hand_file->warnings)
      result.warnings.push_back(hand.hand + ": " + warning);
  }
  result.warnings.push_back(plan::InventedContactsWarning(*object.object, finished.check.located));
  return finished;
}

void PlanProgram::Finish(const CLI::App& app) {
  for (const char* name : {"--turn", "--start-pose", "--goal-pose", "--clearance", "--reserve"}) {
    if (app.count(name) > 0 && !hand.given())
      throw InputError(std::string(name) + " requires --hand");
  }
  if (batch.empty()) {
    for (const char* name : {"--shard", "--fresh"}) {
      if (app.count(name) > 0) throw InputError(std::string(name) + " goes with --batch");
    }
    if (app.count("--jobs") > 0 && !hand.given()) {
      throw InputError("--jobs goes with --batch or --hand");
    }
    return;
  }
  given = GivenOptions(app, {"--help", "--version", "--object", "--start", "--goal", "--hand",
                             "--output", "--batch", "--shard", "--jobs", "--fresh", "--quiet"});
}

}  // namespace regrasp::apps
