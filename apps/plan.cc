// plan: finds a regrasp sequence from a start grasp to a goal grasp and writes a plan.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>

#include "apps/commands.h"
#include "apps/hand_options.h"
#include "apps/help.h"
#include "apps/nearest_word.h"
#include "apps/output_files.h"
#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "planner/certificate/finish_plan.h"
#include "planner/criteria/reach.h"
#include "planner/gait/gait_planner.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/body_measures.h"
#include "planner/object/mesh_defect.h"
#include "planner/plan/check.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/invented_contacts.h"
#include "planner/plan/plan_io.h"
#include "planner/planning/solve.h"
#include "planner/repair/repair.h"
#include "planner/tree/tree_planner.h"
#include "sim/actuation/carry_out.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "plan";

/// A day's work.
constexpr std::int64_t kMostEffort = 100'000'000'000;

/// Instead of a grasp file.
constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

bool IsRandom(const std::string& grasp) { return grasp == kRandom || grasp == kRandomAny; }

/// "2 switches, 1 align".
std::string StepCounts(const std::vector<plan::Step>& steps) {
  std::string text;
  for (const auto& [kind, several] :
       {std::pair("switch", "switches"), {"align", "aligns"}, {"move", "moves"}}) {
    const auto n = std::ranges::count(steps, std::string(kind), plan::StepKind);
    if (n == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? kind : several);
  }
  return text.empty() ? "no steps, the goal is the start" : text;
}

/// Of a plan that a planner found and `validate` would fail.
std::string CheckerComplaint(const plan::PlanCheck& check) {
  const auto failed = std::ranges::find_if(
      check.steps, [](const plan::StepCheck& step) { return step.reason != plan::Reason::kNone; });
  return "the checker fails this plan in step " + std::to_string(failed->index) + ", " +
         failed->kind + ": " + failed->detail;
}

using GivenPoints = std::optional<std::vector<Eigen::Vector3d>>;

struct PlanProgram {
  PlannerOptions common;
  std::string start;
  std::string goal;
  std::string output;
  double min_quality = criteria::GraspCriteria().min_quality;
  double finger_radius = 0;  ///< 0: points
  planning::Objective objective = planning::Objective::kSteps;
  bool no_lazy = false;
  std::optional<std::int64_t> effort;
  bool explain = false;
  HandOptions hand;

  void AddTo(CLI::App& app);
  int Run() const;

 private:
  void AddEnds(CLI::App& app);
  void AddSearch(CLI::App& app);
  planning::GraspChoice Choose(const std::string& option, const std::string& value,
                               const object::Object& object) const;
  planning::PlanRequest RequestFor(const object::Object& object) const;
  planning::PlanResult Find(const object::ObjectFile& object, const GivenPoints& given) const;
  void CheckEnds() const;
  void CheckOutput() const;
  object::ObjectFile ReadObject() const;
  void PrintSummary(const planning::PlanResult& result, const plan::PlanCheck& check) const;
};

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
  app.add_option("--start", start, "Start grasp" + kinds)->type_name("FILE|random|random-any");
  app.add_option("--goal", goal, "Goal grasp" + kinds)->type_name("FILE|random|random-any");
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
      "(every "
      "switch where the smaller of its two grasps' contact regions is largest; default: well "
      "inside "
      "both sets)");
  AddInteger(
      app, "--effort", effort, std::int64_t{1}, kMostEffort,
      "When to give up; the planner general after so many force-closure tests, each of some "
      "microseconds (default " +
          std::to_string(tree::TreePlanner::kDefaultEffort) +
          "), with --hand after so many grasps searched, each of some milliseconds (default " +
          std::to_string(gait::kDefaultExpanded) + ")");
  app.add_flag(
      "--explain", explain,
      "Look for what would be enough where no sequence is found; the smallest friction (of "
      "the planner general), with --hand also the size of the object and a tilt of the "
      "palm, for as long again as --time-limit says");
}

planning::GraspChoice PlanProgram::Choose(const std::string& option, const std::string& value,
                                          const object::Object& object) const {
  using Kind = planning::GraspChoice::Kind;
  // No such file, and nearly one of the words.
  if (!IsRandom(value) && !std::filesystem::exists(value)) {
    const std::string meant = DidYouMean(value, {kRandom, kRandomAny});
    if (!meant.empty()) throw InputError(option + ": there is no file " + value + meant);
  }
  if (!IsRandom(value)) return {Kind::kGiven, plan::ReadGrasp(value, object), value};
  const bool any = value == kRandomAny || common.planner == "auto";
  return {any ? Kind::kRandomAny : Kind::kRandom, {}, option + " " + value};
}

planning::PlanRequest PlanProgram::RequestFor(const object::Object& object) const {
  planning::PlanRequest request = common.RequestFor(object);
  request.hand.fingertip_radius = finger_radius;
  request.criteria.min_quality = min_quality;
  request.objective = objective;
  request.last_resort = !no_lazy;
  request.effort = effort;
  request.explain = explain;
  return request;
}

planning::PlanResult PlanProgram::Find(const object::ObjectFile& object,
                                       const GivenPoints& given) const {
  planning::PlanRequest request = RequestFor(*object.object);
  if (given) request.given_points = &*given;
  kinematics::HandFile model;
  if (hand.given()) {
    if (object.object->dimension() != 3) {
      throw InputError("--hand: hands hold solids, and no planar objects");
    }
    model = kinematics::ReadHandFile(hand.hand);
    planning::InHandTask task{.hand = &model.hand, .scale = common.scale};
    task.carry_out =
        sim::CarryOutTest(model, dynamic_cast<const object::Polyhedron&>(*object.object));
    hand.AskFor(task);
    gait::AskInHand(task, request);
  }
  const planning::Planner& planner = common.PlannerFor(request);
  if (!start.empty()) request.start = Choose("--start", start, *object.object);
  if (!goal.empty()) request.goal = Choose("--goal", goal, *object.object);
  ProgressLine progress(common.quiet);
  request.progress = progress.reporter();
  planning::PlanResult result = planning::Solve(planner, request);
  progress.Clear();
  return result;
}

/// Without a hand a plan is from a grasp to a grasp; a hand chooses those that are not given.
void PlanProgram::CheckEnds() const {
  for (const auto& [option, value] : {std::pair("--start", start), {"--goal", goal}}) {
    if (hand.given() && IsRandom(value)) {
      throw InputError(std::string(option) +
                       ": with --hand a grasp file, or nothing, as the program "
                       "chooses a grasp that the hand reaches; found " +
                       value);
    }
    if (!hand.given() && value.empty()) throw InputError(std::string(option) + " is required");
  }
  hand.Check(start, goal);
}

void PlanProgram::CheckOutput() const {
  if (output == "-") return;
  std::vector<NamedFile> inputs = {{"--object", common.object}};
  for (const NamedFile& end :
       {NamedFile{"--start", start}, {"--goal", goal}, {"--hand", hand.hand}}) {
    if (!end.path.empty() && !IsRandom(end.path.string())) inputs.push_back(end);
  }
  OutputFiles outputs;
  outputs.Add("--output", output);
  CheckOutputsDiffer(inputs, outputs);
  CheckOutputsWritable(outputs);
}

/// A surface that is refused is told what a repair would make of it.
object::ObjectFile PlanProgram::ReadObject() const {
  try {
    return common.ReadObjectFile(kProgram);
  } catch (const object::MeshError& error) {
    ProgressLine progress(common.quiet);
    throw InputError(error.what() + repair::RepairHint(common.object, {progress.reporter(), {}}));
  }
}

int PlanProgram::Run() const {
  CheckEnds();
  CheckOutput();
  if (hand.given()) {  // before the object is read
    planning::InHandTask task;
    hand.AskFor(task);
  }
  const object::ObjectFile object = ReadObject();
  criteria::CheckFingerRadius(*object.object, finger_radius, "--finger-radius");
  const object::BodyMeasures body = object::MeasureBody(*object.object, common.scale);
  const std::vector<std::string> doubts = {object::SizeWarning(body, common.scale),
                                           common.friction.warning()};
  const GivenPoints given = common.ReadGivenPoints();
  planning::PlanResult result = Find(object, given);
  if (!result.plan) {
    PrintError(kProgram, result.message);
    return kExitNegative;
  }
  if (result.plan->roadmap) common.NotePlaces(*result.plan->roadmap);
  const plan::PlanCheck check =
      certificate::FinishPlan(object,
                              {.half_angle = common.friction.required_half_angle(),
                               .scale = common.scale,
                               .shells = common.repair.shells(),
                               .patch_radius = common.PatchRadius(*object.object),
                               .given_points = given ? &*given : nullptr},
                              *result.plan);
  if (!check.passed()) result.warnings.push_back(CheckerComplaint(check));
  result.warnings.push_back(plan::InventedContactsWarning(*object.object, check.located));
  if (given) {
    const double off = plan::FarthestFromPoints(check.located, *given) * common.scale;
    result.notes.push_back("contacts: at given points, at most " + FormatLength(off) + " off");
  }
  const std::string text = plan::FormatPlan(*result.plan);
  if (output == "-") {
    std::cout << text;
  } else {
    WriteFile(output, text);
  }
  result.warnings.insert(result.warnings.begin(), doubts.begin(), doubts.end());
  for (const std::string& warning : result.warnings) {
    if (!warning.empty()) PrintMessage(kProgram, "warning: " + warning);
  }
  if (common.quiet) return kExitDone;
  PrintMessage(kProgram, object.file + ": " + object::MeasuresText(body) +
                             " at the density of water" + object::UnitText(object.unit));
  PrintSummary(result, check);
  return kExitDone;
}

void PlanProgram::PrintSummary(const planning::PlanResult& result,
                               const plan::PlanCheck& check) const {
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - common.begin;
  std::string planner = result.plan->planner;
  if (const auto& note = result.plan->roadmap) {
    planner += " of " + std::to_string(note->clusters) + " clusters (start: " + note->start +
               ", goal: " + note->goal + ")";
  }
  PrintMessage(kProgram, planner + ": " + StepCounts(result.plan->steps) + "; weakest: " +
                             plan::WeakestStepText(check.steps, result.plan->half_angle) + "; " +
                             FormatShort(time.count(), 2) + " s");
  for (const std::string& note : result.notes) PrintMessage(kProgram, note);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  PlanProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
