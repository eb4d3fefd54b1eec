// graph: builds the switching graph and prints what the dissertation's tables print.

#include <chrono>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/angle.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "graph";

/// What is known of a roadmap when it is built.
struct GraphCounts {
  std::int64_t faces = 0;  ///< contact points
  std::int64_t candidates = 0;
  std::int64_t vertices = 0;
  std::int64_t edges = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
};

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

GraphCounts CountGraph(const Polyhedron& solid, const RoadmapOptions& options) {
  Stopwatch stopwatch;
  const Roadmap roadmap = BuildRoadmap(solid, options);
  GraphCounts counts;
  counts.vertex_seconds = stopwatch.Lap();
  options.progress("joining " + std::to_string(roadmap.vertex_count()) + " grasps");
  counts.faces = std::ssize(roadmap.points());
  counts.candidates = roadmap.candidate_count();
  counts.vertices = roadmap.vertex_count();
  counts.edges = roadmap.edge_count();
  counts.components = roadmap.components().count();
  counts.edge_seconds = stopwatch.Lap();
  return counts;
}

Json GraphJson(const GraphCounts& counts, double half_angle) {
  return {{"format", "regrasp-graph"},
          {"version", 1},
          {"planner", "roadmap"},
          {"friction", {{"half_angle_deg", Degrees(half_angle)}}},
          {"faces", counts.faces},
          {"types",
           {{"representative",
             {{"candidates", counts.candidates},
              {"combinations", counts.vertices},
              {"vertices", counts.vertices}}}}},
          {"edges", {{"representative-representative", counts.edges}}},
          {"vertices", counts.vertices},
          {"components", counts.components},
          {"seconds", {{"vertices", counts.vertex_seconds}, {"edges", counts.edge_seconds}}}};
}

std::string GraphTable(const GraphCounts& counts, const std::string& object) {
  std::ostringstream table;
  const auto row = [&](const auto&... cells) {
    ((table << std::setw(12) << cells), ...);
    table << '\n';
  };
  table << "roadmap of " << object << '\n';
  row("#Points", "#Subsets", "#Vert", "#Edges", "#CC", "vert(s)", "edges(s)");
  row(counts.faces, counts.candidates, counts.vertices, counts.edges, counts.components,
      FormatShort(counts.vertex_seconds, 3), FormatShort(counts.edge_seconds, 3));
  return table.str();
}

struct GraphProgram {
  PlannerOptions common;
  std::string json;

  void AddTo(CLI::App& app) {
    common.AddTo(app);
    app.add_option("--json", json,
                   "Also writes the counts as JSON; - is standard output, instead "
                   "of the table")
        ->type_name("FILE");
  }

  int Run() const {
    RoadmapOptions options = common.roadmap();
    const ObjectFile object = ReadObject(common.object);
    const Polyhedron& solid = SolidOf(object, common.object);
    ProgressLine progress(common.quiet);
    options.progress = [&](std::string_view text) { progress.Report(text); };
    const GraphCounts counts = CountGraph(solid, options);
    progress.Clear();
    const std::string text = FormatJson(GraphJson(counts, options.half_angle));
    if (json == "-") {
      std::cout << text;
      return kExitDone;
    }
    if (!json.empty()) WriteFile(json, text);
    std::cout << GraphTable(counts, object.file);
    return kExitDone;
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Builds the switching graph of an object and prints its size.", kProgram);
  GraphProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
