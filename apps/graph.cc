// graph: builds the switching graph and prints what the dissertation's tables print.

#include <iostream>
#include <string>

#include "apps/graph_summary.h"
#include "apps/graph_text.h"
#include "apps/output_files.h"
#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/planning/planner.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/sets/contour/graph_memory.h"

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
  int sampling = 0;
  bool compare = false;
  int queries = 0;
  bool no_lazy = false;

  void AddTo(CLI::App& app) {
    common.AddTo(app, "polygon in the plane, roadmap in space");
    app.add_option("--json", json,
                   "Also writes the counts as JSON; - is standard output, instead "
                   "of the table")
        ->type_name("FILE");
    AddInteger(app, "--sampling", sampling, 1, kMostSamples,
               "The planner polyhedron looks for cells by so many random focus points instead of "
               "directly, in a box that contains all cells");
    app.add_flag("--compare", compare,
                 "With --sampling: also says how much of the direct graph the points found");
    AddInteger(app, "--queries", queries, 1, kMostQueries,
               "A roadmap of clusters also answers so many queries between random force-closure "
               "grasps of its contact points");
    app.add_flag("--no-lazy", no_lazy,
                 "With --queries: no search among the grasps of all contact points where the "
                 "representatives do not join start and goal");
  }

  int Run() const {
    if (sampling > 0 && common.planner != "polyhedron") {
      throw InputError("--sampling: the planner " + common.planner +
                       " draws no focus points; polyhedron does");
    }
    if (compare && sampling == 0) throw InputError("--compare: needs --sampling");
    if (common.planner == "general") {
      throw InputError("--planner general: it searches from grasp to grasp and has no graph");
    }
    const bool may_query = common.planner == "roadmap" || common.planner == "auto";
    if (queries > 0 && !may_query) {
      throw InputError("--queries: the planner " + common.planner + " answers none; roadmap does");
    }
    if (no_lazy && queries == 0) throw InputError("--no-lazy: needs --queries");
    if (json != "-") {
      OutputFiles outputs;
      outputs.Add("--json", json);
      CheckOutputsDiffer({{"--object", common.object}}, outputs);
      CheckOutputsWritable(outputs);
    }
    const object::ObjectFile object = common.ReadObjectFile();
    const double half_angle = common.friction.required_half_angle();
    const GraphSummary summary = Summarize(object);
    const std::string text = FormatJson(GraphJson(summary, half_angle));
    if (json == "-") {
      std::cout << text;
      return kExitDone;
    }
    if (!json.empty()) WriteFile(json, text);
    std::string title = summary.planner + " of " + object.file + ", " +
                        std::to_string(summary.faces) + FacesName(summary.planner) +
                        FormatShort(Degrees(half_angle)) + "°";
    if (summary.planner == "polygon" || summary.planner == "polyhedron") {
      title += ", " + common.spanning;
    }
    if (summary.clusters > 0) title += ", " + std::to_string(summary.clusters) + " clusters";
    if (sampling > 0) title += ", " + std::to_string(sampling) + " focus points";
    std::cout << GraphTable(summary, title);
    if (compare) std::cout << ShareText(*summary.sampling_share);
    return kExitDone;
  }

  GraphSummary Summarize(const object::ObjectFile& object) const {
    ProgressLine progress(common.quiet);
    GraphSummary summary;
    const bool planar = object.object->dimension() == 2;
    if (queries > 0 && planar) {
      throw InputError("--queries: " + common.object + " is planar; only a roadmap answers them");
    }
    planning::PlanRequest request = common.RequestFor(*object.object);
    request.progress = [&](std::string_view text) { progress.Report(text); };
    request.last_resort = !no_lazy;
    const std::string name =
        common.planner != "auto" ? common.planner : (planar ? "polygon" : "roadmap");
    const bool clusters = name == "roadmap" && !planar && roadmap::SizeOf(request).clusters > 0;
    if (queries > 0 && !clusters) {
      throw InputError("--queries: needs a roadmap of clusters (--clusters)");
    }
    const planning::Planner& planner = *registry::FindPlanner(name);
    if (!planner.ScopeIn(object.object->dimension())) {
      throw InputError(planning::WhyNotServed(planner, request));
    }
    // A graph of contour alone takes less than planning on it.
    const auto* polygon = dynamic_cast<const object::Polygon*>(object.object.get());
    common.CheckMemory(name == "contour"
                           ? contour::EstimateContourGraph(*polygon, request.criteria.half_angle)
                           : planner.EstimateMemory(request).value());
    request.progress("building the switching graph");
    summary = SummarizeGraph(name, request, {sampling, queries});
    progress.Clear();
    return summary;
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Builds the switching graph of an object and prints its size.", kProgram);
  GraphProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
