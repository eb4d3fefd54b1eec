// plan: finds a regrasp sequence from a start grasp to a goal grasp and writes a plan; or many.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/output_files.h"
#include "apps/plan_lines.h"
#include "apps/plan_program.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "planner/criteria/reach.h"
#include "planner/object/body_measures.h"
#include "planner/object/mesh_defect.h"
#include "planner/plan/invented_contacts.h"
#include "planner/plan/plan_io.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

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

void CheckOutput(const PlanProgram& program) {
  if (program.output == "-") return;
  std::vector<NamedFile> inputs = {{"--object", program.common.object},
                                   {"--hand", program.hand.hand}};
  for (const PlanEnd& end : {program.start, program.goal}) {
    if (!end.is_random()) inputs.push_back({end.option, end.value});
  }
  OutputFiles outputs;
  outputs.Add("--output", program.output);
  CheckOutputsDiffer(inputs, outputs);
  CheckOutputsWritable(outputs);
}

/// A surface that is refused is told what a repair would make of it.
object::ObjectFile ReadObject(const PlannerOptions& common) {
  try {
    return common.ReadObjectFile(kPlanName);
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
  PrintMessage(kPlanName, planner + ": " + StepCounts(result.plan->steps) + "; weakest: " +
                              plan::WeakestStepText(finished.check.steps, result.plan->half_angle) +
                              "; " + FormatShort(time.count(), 2) + " s");
  for (const std::string& note : result.notes) PrintMessage(kPlanName, note);
}

int RunOne(PlanProgram program) {
  const PlannerOptions& common = program.common;
  program.CheckEnds();
  CheckOutput(program);
  program.ReadHand();
  const object::ObjectFile object = ReadObject(common);
  criteria::CheckFingerRadius(*object.object, program.finger_radius, "--finger-radius");
  const object::BodyMeasures body = object::MeasureBody(*object.object, common.scale);
  const GivenPoints given = common.ReadGivenPoints();
  FinishedPlan finished = program.Plan(object, given);
  planning::PlanResult& result = finished.result;
  if (!result.plan) {
    PrintError(kPlanName, "no plan found: " + result.message);
    return kExitNegative;
  }
  if (given) {
    const double off = plan::FarthestFromPoints(finished.check.located, *given) * common.scale;
    result.notes.push_back("contacts: at given points, at most " + FormatLength(off) + " off");
  }
  const std::string text = plan::FormatPlan(*result.plan);
  if (program.output == "-") {
    std::cout << text;
  } else {
    WriteFile(program.output, text);
  }
  result.warnings.insert(result.warnings.begin(),
                         {object::SizeWarning(body, common.scale), common.friction.warning()});
  for (const std::string& warning : result.warnings) {
    if (!warning.empty()) PrintMessage(kPlanName, "warning: " + warning);
  }
  if (common.quiet) return kExitDone;
  PrintMessage(kPlanName, object.file + ": " + object::MeasuresText(body) +
                              " at the density of water" + object::UnitText(object.unit));
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
