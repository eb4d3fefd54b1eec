// graph: builds the switching graph and prints what the dissertation's tables print.

#include <algorithm>
#include <array>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <limits>
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
#include "planner/roadmap/roadmap_queries.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "graph";

/// More queries take minutes on bodies where many fail.
constexpr int kMostQueries = 100'000;

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

/// Random queries over a roadmap, and the times they took.
struct QuerySummary {
  int count = 0;
  int connected = 0;
  double shortest_seconds = 0;
  double longest_seconds = 0;
  double mean_seconds = 0;
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
  int clusters = 0;  ///< of the contact points of a roadmap
  std::optional<QuerySummary> queries;
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

QuerySummary RunQueries(const Polyhedron& solid, const ClusteredRoadmap& roadmap, int count,
                        const RoadmapOptions& options) {
  options.progress(std::to_string(count) + " random queries");
  QuerySummary summary;
  summary.shortest_seconds = std::numeric_limits<double>::infinity();
  for (const RandomQuery& query : RunRandomQueries(roadmap, kSamePoint * solid.diameter(), count,
                                                   options.seed, options.last_resort)) {
    ++summary.count;
    summary.connected += query.chain.grasps.empty() ? 0 : 1;
    summary.shortest_seconds = std::min(summary.shortest_seconds, query.seconds);
    summary.longest_seconds = std::max(summary.longest_seconds, query.seconds);
    summary.mean_seconds += query.seconds;
  }
  if (summary.count == 0) return {};
  summary.mean_seconds /= summary.count;
  return summary;
}

/// The part of a roadmap's summary that does not depend on its contact points' clusters.
GraphSummary SummarizeRoadmap(const Roadmap& roadmap, const RoadmapOptions& options,
                              Stopwatch& stopwatch) {
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

GraphSummary SummarizeRoadmap(const Polyhedron& solid, const RoadmapOptions& options, int queries) {
  Stopwatch stopwatch;
  if (options.clusters == 0) {
    return SummarizeRoadmap(BuildRoadmap(solid, options), options, stopwatch);
  }
  const ClusteredRoadmap roadmap = BuildClusteredRoadmap(solid, options);
  GraphSummary summary = SummarizeRoadmap(roadmap.roadmap, options, stopwatch);
  summary.faces = roadmap.clusters.clustered_count();
  summary.clusters = roadmap.clusters.cluster_count();
  if (queries > 0) summary.queries = RunQueries(solid, roadmap, queries, options);
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
  if (summary.clusters > 0) json["clusters"] = summary.clusters;
  if (summary.queries) {
    json["queries"] = {{"count", summary.queries->count},
                       {"connected", summary.queries->connected},
                       {"shortest_seconds", summary.queries->shortest_seconds},
                       {"longest_seconds", summary.queries->longest_seconds},
                       {"mean_seconds", summary.queries->mean_seconds}};
  }
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

std::string QueryText(const QuerySummary& queries) {
  const auto milliseconds = [](double seconds) { return FormatShort(1000 * seconds, 3); };
  return std::to_string(queries.connected) + " of " + std::to_string(queries.count) +
         " random queries joined, " + milliseconds(queries.shortest_seconds) + " to " +
         milliseconds(queries.longest_seconds) + " ms each, mean " +
         milliseconds(queries.mean_seconds) + " ms\n";
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
  const std::string queries = summary.queries ? QueryText(*summary.queries) : "";
  const std::string unclear =
      summary.unclear > 0 ? cell(summary.unclear) + " decisions were too close to call\n" : "";
  return title + "\n\n" + FormatTable(types) + "\n" + FormatTable(edges) + "\nvertices " +
         FormatShort(summary.vertex_seconds, 3) + " s, edges " +
         FormatShort(summary.edge_seconds, 3) + " s\n" + unclear + queries;
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
  int queries = 0;
  bool no_lazy = false;

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
    AddInteger(app, "--queries", queries, 1, kMostQueries,
               "A roadmap of clusters also answers so many queries between random force-closure "
               "grasps of its contact points");
    app.add_flag("--no-lazy", no_lazy,
                 "With --queries: no search among the grasps of all contact points where the way "
                 "over the representatives fails");
  }

  int Run() const {
    if (sampling > 0 && common.planner != "polyhedron") {
      throw InputError("--sampling: the planner " + common.planner +
                       " draws no focus points; polyhedron does");
    }
    if (compare && sampling == 0) throw InputError("--compare: needs --sampling");
    const bool may_query = common.planner == "roadmap" || common.planner == "auto";
    if (queries > 0 && !may_query) {
      throw InputError("--queries: the planner " + common.planner + " answers none; roadmap does");
    }
    if (no_lazy && queries == 0) throw InputError("--no-lazy: needs --queries");
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
    if (summary.clusters > 0) title += ", " + std::to_string(summary.clusters) + " clusters";
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
      const Polyhedron& solid = SolidOf(object, common);
      RoadmapOptions options = common.roadmap(solid);
      options.progress = [&](std::string_view text) { progress.Report(text); };
      options.last_resort = !no_lazy;
      if (queries > 0 && options.clusters == 0) {
        throw InputError("--queries: needs a roadmap of clusters (--clusters)");
      }
      summary = SummarizeRoadmap(solid, options, queries);
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
