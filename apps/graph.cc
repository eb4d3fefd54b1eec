// graph: builds the switching graph and prints what the dissertation's tables print.

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

/// More queries take minutes on bodies where many fail.
constexpr int kMostQueries = 100'000;

/// More focus points take minutes.
constexpr int kMostSamples = 10'000'000;

struct GraphProgram {
  PlannerOptions common;
  std::string json;
  int focus_points = 0;
  int queries = 0;
  bool compare = false;
  bool no_lazy = false;

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
  common.AddTo(app, "polygon in the plane, roadmap in space, unless an option asks for another");
  BeginGroup(app, "What is counted and told");
  app.add_option("--json", json,
                 "Also write the counts as JSON; - is standard output, instead "
                 "of the table")
      ->type_name("FILE");
  AddInteger(
      app, "--sampling", focus_points, 1, kMostSamples,
      "Look for cells of the planner polyhedron by so many random focus points: in a box that "
      "contains all cells, instead of directly");
  app.add_flag("--compare", compare,
               "Also say how much of the direct graph the points of --sampling found");
  AddInteger(app, "--queries", queries, 1, kMostQueries,
             "Also answer so many random queries on a roadmap of clusters: between force-closure "
             "grasps of its contact points");
  app.add_flag("--no-lazy", no_lazy,
               "No search beyond the representatives in --queries: none among the grasps of all "
               "contact points where they do not join start and goal");
  app.footer(
      "  graph --object polygon40.wkt --friction-angle 10 --spanning uniform\n"
      "  graph --object part.obj --mu 0.3 --planner polyhedron --json graph.json\n");
}

void GraphProgram::CheckUsage() const {
  if (compare && focus_points == 0) throw InputError("--compare: needs --sampling");
  if (no_lazy && queries == 0) throw InputError("--no-lazy: needs --queries");
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
                      FormatShort(Degrees(common.friction.required_half_angle())) + "°";
  const auto& options = planner.traits().options;
  if (std::ranges::find(options, sets::kUniformSpanningOption) != options.end()) {
    title += common.spanning == planning::Spanning::kUniform ? ", uniform" : ", adaptive";
  }
  if (summary.clusters > 0) title += ", " + std::to_string(summary.clusters) + " clusters";
  if (summary.sampling_share) {
    title += ", " + std::to_string(focus_points) + " focus points";
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
  auto& roadmap = request.parameters.Edit<roadmap::RoadmapParameters>();
  roadmap.last_resort = !no_lazy;
  roadmap.queries = queries;
  request.parameters.Edit<polyhedron::PolyhedronParameters>().focus_points = focus_points;
  const planning::Planner& planner = common.PlannerFor(request);
  const planning::GraphSummary summary = Summarize(planner, request);
  const std::string text = FormatJson(GraphJson(summary, request.criteria.half_angle));
  if (json == "-") {
    std::cout << text;
    return kExitDone;
  }
  if (!json.empty()) WriteFile(json, text);
  std::cout << GraphTable(summary, Title(planner, summary, object.file));
  if (compare) std::cout << ShareText(*summary.sampling_share);
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kProgram), kProgram);
  GraphProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
