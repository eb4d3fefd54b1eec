// graph: builds the switching graph and prints what the dissertation's tables print.

#include <algorithm>
#include <array>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "apps/planner_options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/contour/contour_graph.h"
#include "planner/polygon/polygon_graph.h"
#include "planner/polyhedron/polyhedron_graph.h"
#include "planner/polyhedron/sampled_graph.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "graph";

/// More focus points take minutes.
constexpr int kMostSamples = 10'000'000;

/// How many grasps of one type a graph has.
struct TypeSummary {
  std::string name;
  std::int64_t candidates = 0;
  std::int64_t combinations = 0;
  std::int64_t vertices = 0;
  std::int64_t components = 0;  ///< of the graph, were there only this type
};

/// What is known of a graph when it is built.
struct GraphSummary {
  std::string planner;
  std::int64_t faces = 0;  ///< edges of a polygon, contact points of a roadmap
  std::vector<TypeSummary> types;
  std::vector<std::pair<std::string, std::int64_t>> edges;  ///< by types, as "parallel-parallel"
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
  std::int64_t unclear = 0;  ///< decisions too close to call
  std::optional<SamplingShare> sampling_share;
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

GraphSummary SummarizeRoadmap(const Polyhedron& solid, const RoadmapOptions& options) {
  Stopwatch stopwatch;
  const Roadmap roadmap = BuildRoadmap(solid, options);
  GraphSummary summary;
  summary.planner = "roadmap";
  summary.vertex_seconds = stopwatch.Lap();
  options.progress("joining " + std::to_string(roadmap.vertex_count()) + " grasps");
  const std::int64_t vertices = roadmap.vertex_count();
  summary.faces = std::ssize(roadmap.points());
  summary.vertices = vertices;
  summary.edges = {{"representative-representative", roadmap.edge_count()}};
  summary.components = roadmap.components().count();
  summary.types = {
      {"representative", roadmap.candidate_count(), vertices, vertices, summary.components}};
  summary.edge_seconds = stopwatch.Lap();
  return summary;
}

GraphSummary SummarizePolygon(const Polygon& polygon, double half_angle, Spanning spanning) {
  const PolygonGraph graph(polygon, half_angle, spanning);
  const auto name = [](GraspType type) {
    constexpr std::array kNames = {"concurrent", "two_finger", "parallel"};
    return std::string(kNames[static_cast<int>(type)]);
  };
  GraphSummary summary;
  summary.planner = "polygon";
  summary.faces = polygon.face_count();
  for (const auto type : {GraspType::kConcurrent, GraspType::kTwoFinger, GraspType::kParallel}) {
    const GraspTypeCounts& counts = graph.counts(type);
    summary.types.push_back(
        {name(type), counts.candidates, counts.combinations, counts.vertices, counts.components});
  }
  const auto add_edges = [&](GraspType a, GraspType b) {
    summary.edges.emplace_back(name(a) + "-" + name(b), graph.edge_count(a, b));
  };
  add_edges(GraspType::kConcurrent, GraspType::kConcurrent);
  add_edges(GraspType::kTwoFinger, GraspType::kConcurrent);
  add_edges(GraspType::kParallel, GraspType::kParallel);
  add_edges(GraspType::kTwoFinger, GraspType::kParallel);
  add_edges(GraspType::kTwoFinger, GraspType::kTwoFinger);
  if (spanning == Spanning::kAdaptive) add_edges(GraspType::kConcurrent, GraspType::kParallel);
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  return summary;
}

GraphSummary SummarizeContour(const Polygon& polygon, double half_angle) {
  const ContourGraph graph(polygon, half_angle);
  GraphSummary summary;
  summary.planner = "contour";
  summary.faces = polygon.face_count();
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.edges = {{"two_finger-two_finger", graph.switch_count()}};
  summary.types = {{"two_finger", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  return summary;
}

GraphSummary SummarizePolyhedron(const Polyhedron& solid, double half_angle, Spanning spanning,
                                 int sampling, std::uint64_t seed) {
  PolyhedronGraph graph(solid, half_angle, spanning);
  GraphSummary summary;
  summary.planner = "polyhedron";
  summary.faces = solid.face_count();
  if (sampling > 0) {
    const auto region = FindSamplingRegion(solid, graph);
    Stopwatch stopwatch;
    const SampledGraph sampled =
        SamplePolyhedron(solid, half_angle, spanning, region, sampling, seed);
    const auto found = std::ssize(sampled.quadruples);
    summary.vertex_seconds = stopwatch.Lap();
    summary.vertices = found;
    summary.components = sampled.components;
    summary.edges = {{"concurrent-concurrent", std::ssize(sampled.links)}};
    summary.types = {{"concurrent", graph.candidate_count(), found, found, summary.components}};
    summary.sampling_share = CompareSampling(sampled, graph);
    return summary;
  }
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.edges = {{"concurrent-concurrent", std::ssize(graph.links())}};
  summary.types = {{"concurrent", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  summary.unclear = graph.unclear_count();
  return summary;
}

Json GraphJson(const GraphSummary& summary, double half_angle) {
  Json types = Json::object();
  for (const TypeSummary& type : summary.types) {
    types[type.name] = {{"candidates", type.candidates},
                        {"combinations", type.combinations},
                        {"vertices", type.vertices},
                        {"components", type.components}};
  }
  Json edges = Json::object();
  for (const auto& [name, count] : summary.edges) edges[name] = count;
  Json json = {
      {"format", "regrasp-graph"},
      {"version", 1},
      {"planner", summary.planner},
      {"friction", {{"half_angle_deg", Degrees(half_angle)}}},
      {"faces", summary.faces},
      {"types", types},
      {"edges", edges},
      {"vertices", summary.vertices},
      {"components", summary.components},
      {"seconds", {{"vertices", summary.vertex_seconds}, {"edges", summary.edge_seconds}}}};
  if (summary.planner == "polyhedron") json["unclear"] = summary.unclear;
  if (summary.sampling_share) {
    const SamplingShare& share = *summary.sampling_share;
    json["compare"] = {{"combinations", share.quadruples},
                       {"found_combinations", share.found_quadruples},
                       {"links", share.links},
                       {"found_links", share.found_links}};
  }
  return json;
}

/// Columns as wide as their widest cell, the first to the left, the others to the right.
std::string FormatTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::ostringstream table;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      table << (k == 0 ? std::left : std::right) << (k == 0 ? "" : "  ")
            << std::setw(static_cast<int>(widths[k])) << row[k];
    }
    table << '\n';
  }
  return table.str();
}

std::string GraphTable(const GraphSummary& summary, const std::string& title) {
  const auto cell = [](std::int64_t count) { return std::to_string(count); };
  std::vector<std::vector<std::string>> types = {{"grasps", "#can", "#comb", "#vertex", "#CC"}};
  for (const TypeSummary& type : summary.types) {
    types.push_back({type.name, cell(type.candidates), cell(type.combinations), cell(type.vertices),
                     cell(type.components)});
  }
  if (summary.types.size() > 1) {
    types.push_back({"all", "", "", cell(summary.vertices), cell(summary.components)});
  }
  std::vector<std::vector<std::string>> edges = {{"switches", "#edge"}};
  for (const auto& [name, count] : summary.edges) edges.push_back({name, cell(count)});
  const std::string unclear =
      summary.unclear > 0 ? cell(summary.unclear) + " decisions were too close to call\n" : "";
  return title + "\n\n" + FormatTable(types) + "\n" + FormatTable(edges) + "\nvertices " +
         FormatShort(summary.vertex_seconds, 3) + " s, edges " +
         FormatShort(summary.edge_seconds, 3) + " s\n" + unclear;
}

/// What `faces` counts.
std::string FacesName(const std::string& planner) {
  if (planner == "roadmap") return " contact points, ";
  return planner == "polyhedron" ? " faces, " : " edges, ";
}

/// How many of the direct graph's sets sampling found, and of its links.
std::string ShareText(const SamplingShare& share) {
  const auto part = [](std::int64_t found, std::int64_t all) {
    const double percent =
        all == 0 ? 100 : 100.0 * static_cast<double>(found) / static_cast<double>(all);
    return std::to_string(found) + " of " + std::to_string(all) + " (" + FormatShort(percent, 3) +
           " %)";
  };
  return "of the direct graph sampling found " + part(share.found_quadruples, share.quadruples) +
         " combinations and " + part(share.found_links, share.links) + " links between them\n";
}

struct GraphProgram {
  PlannerOptions common;
  std::string json;
  int sampling = 0;
  bool compare = false;

  void AddTo(CLI::App& app) {
    common.AddTo(app, {.in_plane = "polygon", .in_space = "roadmap"});
    app.add_option("--json", json,
                   "Also writes the counts as JSON; - is standard output, instead "
                   "of the table")
        ->type_name("FILE");
    AddInteger(app, "--sampling", sampling, 1, kMostSamples,
               "The planner polyhedron looks for cells by so many random focus points instead of "
               "directly, in a box that contains all cells");
    app.add_flag("--compare", compare,
                 "With --sampling: also says how much of the direct graph the points found");
  }

  int Run() const {
    if (sampling > 0 && common.planner != "polyhedron") {
      throw InputError("--sampling: the planner " + common.planner +
                       " draws no focus points; polyhedron does");
    }
    if (compare && sampling == 0) throw InputError("--compare: needs --sampling");
    const ObjectFile object = ReadObject(common.object);
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
    if (sampling > 0) title += ", " + std::to_string(sampling) + " focus points";
    std::cout << GraphTable(summary, title);
    if (compare) std::cout << ShareText(*summary.sampling_share);
    return kExitDone;
  }

  GraphSummary Summarize(const ObjectFile& object) const {
    ProgressLine progress(common.quiet);
    GraphSummary summary;
    const bool planar = object.object->dimension() == 2;
    if (common.planner == "polyhedron") {
      progress.Report("building the switching graph");
      summary = SummarizePolyhedron(SolidOf(object, common), common.friction.required_half_angle(),
                                    common.spanning_value(), sampling, common.seed);
    } else if (common.planner == "contour") {
      progress.Report("building the switching graph");
      summary = SummarizeContour(PolygonOf(object, common), common.friction.required_half_angle());
    } else if (common.planner == "polygon" || (common.planner == "auto" && planar)) {
      progress.Report("building the switching graph");
      summary = SummarizePolygon(PolygonOf(object, common), common.friction.required_half_angle(),
                                 common.spanning_value());
    } else {
      RoadmapOptions options = common.roadmap();
      options.progress = [&](std::string_view text) { progress.Report(text); };
      summary = SummarizeRoadmap(SolidOf(object, common), options);
    }
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
