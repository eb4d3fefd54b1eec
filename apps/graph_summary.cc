#include "apps/graph_summary.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/roadmap_queries.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::apps {

namespace {

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

QuerySummary RunQueries(const roadmap::ClusteredRoadmap& roadmap, int count,
                        const planning::PlanRequest& request) {
  request.progress(std::to_string(count) + " random queries");
  QuerySummary summary;
  summary.shortest_seconds = std::numeric_limits<double>::infinity();
  for (const roadmap::RandomQuery& query :
       roadmap::RunRandomQueries(roadmap, dynamic_cast<const object::Polyhedron&>(*request.object),
                                 count, request.seed, request.last_resort)) {
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
GraphSummary SummarizeRoadmap(const roadmap::Roadmap& roadmap, const planning::PlanRequest& request,
                              Stopwatch& stopwatch) {
  GraphSummary summary;
  summary.planner = "roadmap";
  summary.vertex_seconds = stopwatch.Lap();
  request.progress("joining " + std::to_string(roadmap.vertex_count()) + " grasps");
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

GraphSummary SummarizePolygon(const planning::PlanRequest& request) {
  const auto& polygon = dynamic_cast<const object::Polygon&>(*request.object);
  const polygon::PolygonGraph graph(polygon, request.criteria.half_angle, request.spanning);
  const auto name = [](polygon::GraspType type) {
    constexpr std::array kNames = {"concurrent", "two_finger", "parallel"};
    return std::string(kNames[static_cast<int>(type)]);
  };
  GraphSummary summary;
  summary.planner = "polygon";
  summary.faces = polygon.face_count();
  for (const auto type : {polygon::GraspType::kConcurrent, polygon::GraspType::kTwoFinger,
                          polygon::GraspType::kParallel}) {
    const polygon::GraspTypeCounts& counts = graph.counts(type);
    summary.types.push_back(
        {name(type), counts.candidates, counts.combinations, counts.vertices, counts.components});
  }
  const auto add_edges = [&](polygon::GraspType a, polygon::GraspType b) {
    summary.edges.emplace_back(name(a) + "-" + name(b), graph.edge_count(a, b));
  };
  add_edges(polygon::GraspType::kConcurrent, polygon::GraspType::kConcurrent);
  add_edges(polygon::GraspType::kTwoFinger, polygon::GraspType::kConcurrent);
  add_edges(polygon::GraspType::kParallel, polygon::GraspType::kParallel);
  add_edges(polygon::GraspType::kTwoFinger, polygon::GraspType::kParallel);
  add_edges(polygon::GraspType::kTwoFinger, polygon::GraspType::kTwoFinger);
  if (request.spanning == planning::Spanning::kAdaptive)
    add_edges(polygon::GraspType::kConcurrent, polygon::GraspType::kParallel);
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  return summary;
}

GraphSummary SummarizeContour(const planning::PlanRequest& request) {
  const auto& polygon = dynamic_cast<const object::Polygon&>(*request.object);
  const contour::ContourGraph graph(polygon, request.criteria.half_angle);
  GraphSummary summary;
  summary.planner = "contour";
  summary.faces = polygon.face_count();
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.edges = {{"two_finger-two_finger", std::ssize(graph.switches())}};
  summary.types = {{"two_finger", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  return summary;
}

GraphSummary SummarizePolyhedron(const planning::PlanRequest& request, int sampling) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*request.object);
  const double half_angle = request.criteria.half_angle;
  polyhedron::PolyhedronGraph graph(solid, half_angle, request.spanning);
  GraphSummary summary;
  summary.planner = "polyhedron";
  summary.faces = solid.face_count();
  if (sampling > 0) {
    const auto region = polyhedron::FindSamplingRegion(solid, graph);
    Stopwatch stopwatch;
    const polyhedron::SampledGraph sampled = polyhedron::SamplePolyhedron(
        solid, half_angle, request.spanning, region, sampling, request.seed);
    const auto found = std::ssize(sampled.quadruples);
    summary.vertex_seconds = stopwatch.Lap();
    summary.vertices = found;
    summary.components = sampled.components;
    summary.edges = {{"concurrent-concurrent", std::ssize(sampled.links)}};
    summary.types = {{"concurrent", graph.candidate_count(), found, found, summary.components}};
    summary.sampling_share = polyhedron::CompareSampling(sampled, graph);
    return summary;
  }
  summary.vertices = graph.vertex_count();
  summary.components = graph.components().count();
  summary.edges = {{"concurrent-concurrent", std::ssize(graph.switches())}};
  summary.types = {{"concurrent", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  summary.vertex_seconds = graph.vertex_seconds();
  summary.edge_seconds = graph.edge_seconds();
  summary.unclear = graph.unclear_count();
  return summary;
}

GraphSummary SummarizeRoadmap(const planning::PlanRequest& request, int queries) {
  Stopwatch stopwatch;
  if (roadmap::SizeOf(request).clusters == 0) {
    return SummarizeRoadmap(roadmap::BuildRoadmap(request, roadmap::SpreadContacts(request)),
                            request, stopwatch);
  }
  const roadmap::ClusteredRoadmap roadmap = roadmap::BuildClusteredRoadmap(request);
  GraphSummary summary = SummarizeRoadmap(roadmap.roadmap, request, stopwatch);
  summary.faces = roadmap.clusters.clustered_count();
  summary.clusters = roadmap.clusters.cluster_count();
  if (queries > 0) summary.queries = RunQueries(roadmap, queries, request);
  return summary;
}

}  // namespace

GraphSummary SummarizeGraph(const std::string& planner, const planning::PlanRequest& request,
                            const GraphTasks& tasks) {
  if (planner == "polygon") return SummarizePolygon(request);
  if (planner == "contour") return SummarizeContour(request);
  if (planner == "polyhedron") return SummarizePolyhedron(request, tasks.sampling);
  return SummarizeRoadmap(request, tasks.queries);
}

}  // namespace regrasp::apps
