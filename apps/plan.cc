// plan: finds a regrasp sequence from a start grasp to a goal grasp and writes a plan. With
// --batch, it plans for many queries.

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/output_files.h"
#include "apps/plan_lines.h"
#include "apps/plan_page.h"
#include "apps/plan_program.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/object/body_measures.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "sim/scene/scaling.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

/// Return the numbers of steps by kind, as text.
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

void CheckOutput(const PlanProgram& program) {
  std::vector<NamedFile> inputs = {{"--object", program.common.object},
                                   {"--hand", program.hand.hand},
                                   {"--goals", program.hand.goals},
                                   {"--continue", program.hand.continue_plan}};
  for (const PlanEnd& end : {program.start, program.goal}) {
    if (!end.is_random()) inputs.push_back({end.option, FileOfEnd(end.value)});
  }
  OutputFiles outputs;
  if (program.output != "-") outputs.Add("--output", program.output);
  outputs.Add("--output", program.page);
  CheckOutputsDiffer(inputs, outputs);
  CheckOutputsWritable(outputs);
}

/// Read the object.
/// An error about its surface includes the expected result of a repair.
object::ObjectFile ReadObject(const PlannerOptions& common) {
  try {
    object::ObjectFile file = common.ReadObjectFile(kPlanName);
    sim::CheckDiameter(common.scale * file.object->diameter());
    return file;
  } catch (const object::MeshError& error) {
    ProgressLine progress(common.quiet);
    throw InputError(error.what() + RepairHint(common.object, {progress.reporter(), {}}));
  }
}

void PrintSummary(const PlannerOptions& common, const FinishedPlan& finished) {
  const planning::PlanResult& result = finished.result;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - common.begin;
  std::string planner = result.plan->planner;
  if (const auto& note = result.plan->roadmap) {
    planner += " of " + std::to_string(note->clusters) + " clusters (start: " + note->start +
               ", goal: " + note->goal + ")";
  }
  PrintMessage(kPlanName,
               planner + ": " + StepCounts(result.plan->steps) + "; weakest: " +
                   plan::WeakestStepText(finished.check.steps, result.plan->friction_angle) + "; " +
                   FormatPlain(time.count(), 2) + " s");
  for (const std::string& note : result.notes) PrintMessage(kPlanName, note);
}

/// Return the size of a solid's bounding box: "60 × 60 × 60 mm".
/// It is measured along the axes of the solid's file.
std::string BoxText(const object::Polyhedron& solid, double scale) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : solid.vertices()) box.extend(vertex);
  constexpr double kMillimetres = 1000;
  std::string text;
  for (const double size : box.sizes()) {
    text += (text.empty() ? "" : " × ") + FormatPlain(size * scale * kMillimetres, 3);
  }
  return text + " mm";
}

/// Print size and mass before the search for a hand's plan.
/// The user then notices a wrong unit of length at once, instead of after minutes of search without
/// result.
void PrintSize(const PlanProgram& program, const object::ObjectFile& object,
               object::BodyMeasures body) {
  const PlannerOptions& common = program.common;
  const std::optional<double> mass_kg = program.MassInSimulation();
  body.mass_kg = mass_kg.value_or(body.mass_kg);
  const std::string warning = object::SizeWarning(body, common.scale);
  if (!warning.empty()) PrintMessage(kPlanName, "warning: " + warning);
  const auto* solid = dynamic_cast<const object::Polyhedron*>(object.object.get());
  if (common.quiet || solid == nullptr) return;
  PrintMessage(kPlanName, object.file + ": " + BoxText(*solid, common.scale) + ", " +
                              object::MeasuresText(body) +
                              (mass_kg ? "" : " at the density of water") +
                              object::UnitText(object.unit));
}

void WriteOutputs(const PlanProgram& program, const object::ObjectFile& object,
                  const FinishedPlan& finished) {
  const plan::Plan& plan = *finished.result.plan;
  const std::string text = plan::FormatPlan(plan);
  std::string page;
  if (!program.page.empty()) {
    const bool has_file = !program.output.empty() && program.output != "-";
    const std::filesystem::path named = has_file ? program.output : program.page;
    page = FormatPlanPage(object, plan, finished.check, program.hand_file.get(),
                          named.filename().string());
  }
  if (program.output == "-") {
    std::cout << text;
  } else if (!program.output.empty()) {
    WriteFile(program.output, text);
  }
  if (!program.page.empty()) WriteFile(program.page, page);
}

int RunOne(PlanProgram program) {
  const PlannerOptions& common = program.common;
  program.ReadHandGrasps();
  program.CheckEnds();
  CheckOutput(program);
  program.ReadHand();
  const object::ObjectFile object = ReadObject(common);
  criteria::CheckFingerRadius(*object.object, program.finger_radius, "--finger-radius");
  const object::BodyMeasures body = object::MeasureBody(*object.object, common.scale);
  const GivenPoints given = common.ReadGivenPoints();
  const bool has_hand = program.hand.given();
  if (has_hand) program.on_search = [&] { PrintSize(program, object, body); };
  FinishedPlan finished = program.Plan(object, given);
  planning::PlanResult& result = finished.result;
  if (!result.plan) {
    PrintError(kPlanName, "no plan found: " + result.message);
    return kExitNegative;
  }
  if (given) {
    const double off = plan::FarthestFromPoints(finished.check.projected, *given) * common.scale;
    result.notes.push_back("contacts: at given points, at most " + FormatLength(off) + " off");
  }
  WriteOutputs(program, object, finished);
  result.warnings.insert(
      result.warnings.begin(),
      {has_hand ? "" : object::SizeWarning(body, common.scale), common.friction.warning()});
  for (const std::string& warning : result.warnings) {
    if (!warning.empty()) PrintMessage(kPlanName, "warning: " + warning);
  }
  if (common.quiet) return kExitDone;
  if (!has_hand) {
    PrintMessage(kPlanName, object.file + ": " + object::MeasuresText(body) +
                                " at the density of water" + object::UnitText(object.unit));
  }
  PrintSummary(common, finished);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kPlanName), kPlanName);
  PlanProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] {
    program.Finish(app);
    return program.batch.empty() ? RunOne(program) : RunPlanLines(program);
  });
}
