// graph: builds the switching graph and prints the dissertation's table values.

#include <algorithm>
#include <iostream>
#include <string>

#include "apps/commands.h"
#include "apps/graph_text.h"
#include "apps/help.h"
#include "apps/output_files.h"
#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_parameters.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "graph";

struct GraphProgram {
  PlannerOptions common;
  std::string json;

  void AddTo(CLI::App& app);
  int Run() const;

 private:
  void CheckUsage() const;
  [[nodiscard]] planning::GraphSummary Summarize(const planning::Planner& planner,
                                                 planning::PlanRequest request) const;
  [[nodiscard]] std::string Title(const planning::Planner& planner,
                                  const planning::GraphSummary& summary,
                                  const std::string& object) const;
};

void GraphProgram::AddTo(CLI::App& app) {
  common.AddTo(app, PlannerOptions::Purpose::kGraph);
  BeginGroup(app, "Output");
  app.add_option("--json", json, "Write the counts as JSON. - is standard output")
      ->type_name("FILE");
  SetUsage(app, "--object FILE (--friction-angle DEG | --mu X)");
  MarkRare(app, {"--patch"});
  app.footer(
      "  graph --object polygon40.wkt --friction-angle 10 --planner polygon,spanning=uniform\n"
      "  graph --object part.obj --mu 0.3 --planner polyhedron --json graph.json\n");
}

void GraphProgram::CheckUsage() const {
  if (common.compare && common.focus_points == 0) {
    throw InputError(
        "--planner compare: requires the setting sampling, as in --planner "
        "polyhedron,sampling=1000,compare");
  }
  if (!common.fallback && common.queries == 0) {
    throw InputError("--planner fallback: requires the setting queries");
  }
  if (json == "-") return;
  OutputFiles outputs;
  outputs.Add("--json", json);
  CheckOutputsDiffer({{"--object", common.object}}, outputs);
  CheckOutputsWritable(outputs);
}

planning::GraphSummary GraphProgram::Summarize(const planning::Planner& planner,
                                               planning::PlanRequest request) const {
  ProgressLine progress(common.quiet);
  request.progress = progress.reporter();
  try {
    return planner.SummarizeGraph(request);
  } catch (const TimeUp& time_up) {
    throw TimeUp("the graph of the planner " + planner.name() + " was not complete when " +
                 time_up.what());
  }
}

std::string GraphProgram::Title(const planning::Planner& planner,
                                const planning::GraphSummary& summary,
                                const std::string& object) const {
  std::string title = planner.name() + " of " + object + ", " + std::to_string(summary.faces) +
                      " " + summary.face_name + ", " +
                      FormatShort(Degrees(common.friction.required_friction_angle())) + "°";
  const auto& options = planner.traits().options;
  if (std::ranges::find(options, sets::kUniformSpanningOption) != options.end()) {
    title += common.spanning == planning::Spanning::kUniform ? ", uniform" : ", adaptive";
  }
  if (summary.clusters > 0) title += ", " + std::to_string(summary.clusters) + " clusters";
  if (summary.sampling_share) {
    title += ", " + std::to_string(common.focus_points) + " focus points";
  }
  return title;
}

int GraphProgram::Run() const {
  CheckUsage();
  const object::ObjectFile object = common.ReadObjectFile(kProgram);
  planning::PlanRequest request = common.RequestFor(*object.object);
  const auto given_points = common.ReadGivenPoints();
  if (given_points) request.given_points = &*given_points;
  request.for_graph = true;
  request.parameters.Edit<roadmap::RoadmapParameters>().queries = common.queries;
  request.parameters.Edit<polyhedron::PolyhedronParameters>().focus_points = common.focus_points;
  const planning::Planner& planner = common.PlannerFor(request);
  const planning::GraphSummary summary = Summarize(planner, request);
  const std::string text = FormatJson(GraphJson(summary, request.criteria.friction_angle));
  if (json == "-") {
    std::cout << text;
    return kExitDone;
  }
  if (!json.empty()) WriteFile(json, text);
  std::cout << GraphTable(summary, Title(planner, summary, object.file));
  if (common.compare) std::cout << ShareText(*summary.sampling_share);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  GraphProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
