#include "apps/plan_program.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "apps/help.h"
#include "apps/options.h"
#include "apps/plan_object.h"
#include "apps/plan_page.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/certificate/align_certificate.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/goal_list.h"
#include "planner/gait/request.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/tree/tree_planner.h"
#include "sim/actuation/simulate_execution.h"
#include "sim/hand/check_hand.h"
#include "sim/hand_grasps/fingertip_grasp.h"

namespace regrasp::apps {

namespace {

/// Word that replaces a grasp file.
constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

constexpr int kMostJobs = 1024;

}  // namespace

bool PlanEnd::is_random() const {
  return text.empty() && (value == kRandom || value == kRandomAny);
}

PlanProgram::PlanProgram()
    : jobs(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostJobs)) {}

void PlanProgram::AddTo(CLI::App& app) {
  common.AddTo(app, PlannerOptions::Purpose::kPlan);
  AddSearch(app);
  BeginGroup(app, "Start and goal");
  AddEnds(app);
  hand.AddTo(app);
  BeginGroup(app, "Output");
  app.add_option("-o,--output", outputs,
                 "Plan file. - is standard output. With the suffix .html a page with the "
                 "interactive 3-D replay of the planned motion. Repeat it for both")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  BeginGroup(app, "Many plans");
  AddBatch(app);
  SetUsage(app,
           "--object FILE (--start FILE --goal FILE | --hand FILE --turn AXIS,DEGREES) "
           "(--friction-angle DEG | --mu X) --output FILE");
  app.footer(
      "  plan --object cube.obj --friction-angle 20 --start start.json --goal goal.json \\\n"
      "       --output plan.json\n"
      "  plan --object part.stl --scale 0.001 --mu 0.5 --start random --goal random --seed 7 \\\n"
      "       --output - | validate --object part.stl --plan -\n");
}

void PlanProgram::AddEnds(CLI::App& app) {
  app.add_option("--start", start.value,
                 "Start grasp. A grasp file, random (from the planner's graph; random-any with "
                 "--planner auto) or random-any (uniform on the surface). Required without --hand, "
                 "which supports files only. With --hand also a hand grasp, FILE:NAME: its object "
                 "pose, fingertip contacts and joint angles are the start")
      ->type_name("FILE|random|random-any");
  app.add_option("--goal", goal.value,
                 "Goal grasp. As --start. For a hand grasp, object pose and contacts are the goal; "
                 "joint angles are free")
      ->type_name("FILE|random|random-any");
}

void PlanProgram::AddSearch(CLI::App& app) {
  AddNumber(app, "--min-quality", min_quality, NumberRange::NotNegative(),
            "Minimum grasp quality ε (Ferrari-Canny) of random grasps. The plan prefers such "
            "grasps, and a warning names the weakest step below it. Normal forces sum to 1, "
            "torques are relative to half the diameter [default: 0.01]");
  AddNumber(app, "--finger-radius", finger_radius, NumberRange::Positive(),
            "Radius of the fingers, object units. Contacts that a finger cannot approach along the "
            "normal and grasps with overlapping fingers are avoided [default: 0, point fingers]",
            "R");
  AddChoice<planning::Objective>(
      app, "--optimize", objective,
      {{"steps", planning::Objective::kSteps},
       {"margin", planning::Objective::kMargin},
       {"travel", planning::Objective::kTravel},
       {"regions", planning::Objective::kRegions}},
      "Objective [default: steps]\n"
      "steps: fewest steps, then largest margin of the weakest grasp\n"
      "margin: largest margin, with at most two more steps; with --hand the fewest "
      "failures under validate --conditions standard, then the largest tolerance margin in "
      "simulation\n"
      "travel: fewest steps, then least fingertip travel\n"
      "regions (planner contour): largest independent contact regions");
  app.add_flag("--explain", explain,
               "If no plan is found, search for a sufficient change. The smallest friction "
               "(planner general); with --hand also object size and palm tilt. Takes up to "
               "another --time-limit");
  MarkRare(app, {"--patch"});
}

void PlanProgram::AddBatch(CLI::App& app) {
  app.add_option("--batch", batch,
                 "File of queries in JSON Lines. --output has one line per query, a plan or the "
                 "reason why there is none. Other options are defaults of all queries, and "
                 "--object is their object or a folder of objects. An interrupted run continues")
      ->type_name("FILE");
  app.add_option("--shard", shard, "Part I of N of the queries. `merge` joins the results")
      ->type_name("I/N");
  AddInteger(app, "-j,--jobs", jobs, 1, kMostJobs,
             "Number of parallel queries with --batch, or searches with --hand. Without "
             "--time-limit plans do not depend on it [default: one per processor]");
  app.add_flag("--restart", fresh, "Discard the results of an earlier run of --batch");
  MarkRare(app, {"--shard"});
}

planning::GraspChoice PlanProgram::Choose(const PlanEnd& end, const object::Object& object) const {
  using Kind = planning::GraspChoice::Kind;
  if (!end.text.empty()) {
    try {
      return {Kind::kGiven, plan::ParseGrasp(end.text, end.name, object), end.name};
    } catch (const InputError&) {
      if (end.name != start.name || !continues_rolled) throw;
      throw InputError("--continue: " + hand.continue_plan +
                       ": the plan ends with a rolled contact on an edge of the object, expected "
                       "contacts on faces; help: plan its last part without --rolling on");
    }
  }
  const std::string& value = end.value;
  // The value is not a file, but it may be a misspelt word.
  std::error_code error;  // the name may be too long
  if (!end.is_random() && !std::filesystem::exists(value, error)) {
    const std::string meant = SimilarWord(value, {kRandom, kRandomAny});
    if (!meant.empty()) throw InputError(end.option + ": file " + value + " not found" + meant);
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
  request.parameters.Edit<planning::SearchParameters>().explain = explain;
  if (batch.empty()) request.jobs = jobs;  // a batch uses the jobs for its processes
  return request;
}

plan::HandEnd PlanProgram::StateOf(const NamedHandGrasp& given, const object::ObjectFile& object,
                                   double clearance) const {
  return sim::FingertipGraspOf(given.grasp,
                               {*hand_file, dynamic_cast<const object::Polyhedron&>(*object.object),
                                object.file, common.scale, clearance},
                               given.name);
}

std::optional<double> PlanProgram::MassInSimulation() const {
  if (hand.mass_kg || !continued) return hand.mass_kg;
  return continued->hand->mass_kg;
}

void PlanProgram::CheckContinued(const object::Polyhedron& solid) const {
  const auto faults = sim::CheckHand(*hand_file, solid, plan::ProjectPlan(solid, *continued),
                                     {.clearance_m = hand.clearance_m});
  if (faults.empty()) return;
  throw InputError("--continue: " + hand.continue_plan + ": step " +
                   std::to_string(faults.front().entry) + " fails the hand check (" +
                   std::string(plan::ReasonName(faults.front().reason)) +
                   "): " + faults.front().detail);
}

planning::InHandTask PlanProgram::TaskFor(const object::ObjectFile& object, PlanEnd& from,
                                          PlanEnd& to) const {
  planning::InHandTask task{.hand = &hand_file->hand, .scale = common.scale};
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*object.object);
  task.simulate = sim::ExecutionSimulator(*hand_file, solid,
                                          sim::PlanningConditions(hand.robustness.conditions));
  task.rate = sim::ExecutionRater(*hand_file, solid);
  task.measure_force = sim::GraspForceMeter(*hand_file, solid);
  hand.AskFor(task);
  task.mass_kg = MassInSimulation();
  const auto set_contacts = [&](const plan::HandEnd& state, PlanEnd& end) {
    end.text = plan::FormatGrasp(plan::ContactsOf(state.grasp), object.object->dimension());
    end.name = end.hand_grasp->name;
  };
  std::optional<plan::HandEnd> begin;
  if (continued) {
    CheckPlanFits(*continued, object, {hand.continue_plan, common.object, false, common.scale});
    CheckContinued(solid);
    begin = plan::EndOfPlan(*continued);
    if (continued->hand->gravity_support) task.gravity_support = continued->hand->gravity_support;
  } else if (from.hand_grasp) {
    begin = StateOf(*from.hand_grasp, object, task.margin);
    set_contacts(*begin, from);
  }
  if (begin) gait::StartFrom(*begin, task);
  if (to.hand_grasp) {
    plan::HandEnd end = StateOf(*to.hand_grasp, object, task.margin);
    if (begin) sim::KeepContacts(*begin, common.scale, end);
    set_contacts(end, to);
    gait::EndAt(end, hand.GoalTolerance(), task);
  }
  return task;
}

planning::PlanResult PlanProgram::Find(const object::ObjectFile& object,
                                       const GivenPoints& given) const {
  planning::PlanRequest request = RequestFor(*object.object);
  if (given) request.given_points = &*given;
  PlanEnd from = start;
  PlanEnd to = goal;
  if (hand_file) {
    if (object.object->dimension() != 3) {
      throw InputError("--hand: requires a solid, found a planar object");
    }
    gait::AskInHand(TaskFor(object, from, to), request);
  }
  const planning::Planner& planner = common.PlannerFor(request);
  if (from.given()) request.start = Choose(from, *object.object);
  if (to.given()) request.goal = Choose(to, *object.object);
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

void PlanProgram::ReadHandGrasps() {
  for (PlanEnd* end : {&start, &goal}) {
    end->hand_grasp.reset();
    if (!end->text.empty()) {
      if (!IsHandGrasp(end->text)) continue;
      end->hand_grasp = {sim::ParseHandGrasp(end->text, end->name), end->name};
    } else if (!end->is_random()) {
      end->hand_grasp = FindHandGrasp(end->option, end->value);
    }
    if (end->hand_grasp && !hand.given()) {
      throw InputError(end->option + ": a hand grasp requires --hand");
    }
  }
}

void PlanProgram::CheckEnds() const {
  for (const PlanEnd& end : {start, goal}) {
    if (hand.given() && end.is_random()) {
      throw InputError("with --hand, " + end.option + " must be a grasp file, found " + end.value);
    }
    // Without a hand, a plan requires both grasps. With a hand, the planner chooses those that are
    // not given.
    if (!hand.given() && !end.given()) throw InputError(end.option + " is required");
  }
  hand.Check(
      {start.given(), goal.given(), start.hand_grasp.has_value(), goal.hand_grasp.has_value()});
}

void PlanProgram::ReadHand() {
  if (!hand.given()) return;
  planning::InHandTask task;
  hand.AskFor(task);  // checks the options before any file is read
  hand_file = std::make_shared<const kinematics::HandFile>(kinematics::ReadHandFile(hand.hand));
  task.hand = &hand_file->hand;
  hand.AskFor(task);  // reads the goals
  if (!hand.continue_plan.empty()) ReadContinuedPlan();
}

void PlanProgram::ReadContinuedPlan() {
  const std::string& path = hand.continue_plan;
  continued = std::make_shared<const plan::Plan>(plan::ReadPlan(path));
  if (!continued->hand) throw InputError("--continue: " + path + ": requires a plan for a hand");
  if (continued->hand->sha256 != hand_file->hand.sha256) {
    throw InputError("--continue: " + path + ": the plan is for another hand, expected " +
                     DescribeFile(continued->hand->file, continued->hand->sha256) + ", found " +
                     DescribeFile(hand_file->hand.file, hand_file->hand.sha256));
  }
  hand_file =
      std::make_shared<const kinematics::HandFile>(kinematics::HandOfPlan(*hand_file, *continued));
  const plan::FingerGrasp grasp = plan::EndOfPlan(*continued).grasp;
  continues_rolled = plan::HasRolling(*continued);
  start.text = plan::FormatGrasp(plan::ContactsOf(grasp), continued->dimension);
  start.name = path + ": the grasp after the last step";
}

FinishedPlan PlanProgram::Plan(const object::ObjectFile& object, const GivenPoints& given) const {
  FinishedPlan finished{Find(object, given), {}};
  planning::PlanResult& result = finished.result;
  if (!result.plan) return finished;
  if (result.plan->roadmap) common.NotePlaces(*result.plan->roadmap);
  finished.check =
      certificate::FinishPlan(object,
                              {.friction_angle = common.friction.required_friction_angle(),
                               .scale = common.scale,
                               .shells = common.repair.shells(),
                               .patch_radius = common.PatchRadius(*object.object),
                               .given_points = given ? &*given : nullptr},
                              *result.plan);
  for (std::string& warning : certificate::PlanWarnings(*object.object, finished.check)) {
    result.warnings.push_back(std::move(warning));
  }
  if (hand_file) {
    for (const std::string& warning : hand_file->warnings)
      result.warnings.push_back(hand.hand + ": " + warning);
  }
  return finished;
}

void PlanProgram::Finish(const CLI::App& app) {
  const PlanOutputs sorted = SortPlanOutputs(outputs);
  output = sorted.plan;
  page = sorted.page;
  if (!batch.empty() && !page.empty()) {
    throw InputError("--output: with --batch expected a JSON Lines file, found " + page);
  }
  for (const char* name :
       {"--turn", "--start-pose", "--goal-pose", "--goal-facing", "--goal-tolerance", "--clearance",
        "--goals", "--gravity", "--mass", "--closure", "--rolling", "--continue", "--robustness"}) {
    if (app.count(name) > 0 && !hand.given())
      throw InputError(std::string(name) + " requires --hand");
  }
  if (batch.empty()) {
    for (const char* name : {"--shard", "--restart"}) {
      if (app.count(name) > 0) throw InputError(std::string(name) + " requires --batch");
    }
    if (app.count("--jobs") > 0 && !hand.given()) {
      throw InputError("--jobs requires --batch or --hand");
    }
    return;
  }
  for (const char* name : {"--goals", "--continue"}) {
    if (app.count(name) > 0) throw InputError(std::string(name) + ": cannot be used with --batch");
  }
  const std::set<std::string> change_nothing = {"--help",  "--version", "--object",  "--start",
                                                "--goal",  "--hand",    "--output",  "--batch",
                                                "--shard", "--jobs",    "--restart", "--quiet"};
  given = GivenOptions(app, change_nothing);
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (!change_nothing.contains(name) || name == "--hand") options_of_plans.push_back(name);
  }
}

}  // namespace regrasp::apps
