#include "planner/sets/polyhedron/polyhedron_planner.h"

#include <cmath>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/memory.h"
#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/normal_quadruples.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"
#include "planner/sets/polyhedron/polyhedron_model.h"
#include "planner/sets/set_graph.h"
#include "planner/sets/set_parameters.h"
#include "planner/sets/set_planner.h"

namespace regrasp::polyhedron {

namespace {

/// Number of faces on which candidates are counted, in a few hundredths of a second.
constexpr int kCountedFaces = 60;

/// Memory per element, measured as the peak of resident memory on objects of 24 to 67 faces. A cell
/// includes its pieces and triples, a switch its two entries in the lists of neighbours. The
/// constant `switches` was 75 to 150.
constexpr sets::JoinedGraph kMeasured = {
    .bytes = {.candidates = 60, .sets = 840, .switches = 25}, .common_faces = 3, .switches = 100};

/// Number of cells per candidate; 0.5 to 1.1 on the same objects.
constexpr double kCellsOfCandidate = 0.75;

}  // namespace

MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double friction_angle,
                                   planning::Spanning spanning) {
  std::vector<Eigen::Vector3d> normals;
  for (const FaceIndex face :
       sets::DrawFaces(solid, kCountedFaces, RandomStream(0, RandomUse::kCountedFaces))) {
    normals.push_back(solid.inward_normal(face));
  }
  const auto counted = static_cast<double>(
      FindQuadrupleCandidates(normals, std::tan(friction_angle), spanning).size());
  const double m = static_cast<double>(normals.size());
  return sets::NeedOfGraph("polyhedron", solid, [=](double n) {
    const double candidates = sets::ScaleUp(counted, 4, m, n);
    // Each pair of faces has two rows with one bit per face, and one byte per pair of their halves.
    return kMeasured.BytesOf({candidates, kCellsOfCandidate * candidates}, n) + n * n * n / 4 +
           4 * n * n;
  });
}

namespace {

const object::Polyhedron& SolidOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polyhedron&>(*request.object);
}

/// Summarize the graph found by random focus points, with its share of the direct one.
planning::GraphSummary SummarizeSampled(PolyhedronGraph& graph,
                                        const planning::PlanRequest& request,
                                        planning::GraphSummary summary) {
  const auto region = FindSamplingRegion(SolidOf(request), graph, request.deadline);
  Stopwatch stopwatch;
  const SampledGraph sampled =
      SamplePolyhedron(SolidOf(request), request.criteria.friction_angle, sets::SpanningOf(request),
                       region, request.parameters.Get<PolyhedronParameters>().focus_points,
                       request.seed, request.deadline, request.progress);
  summary.vertex_seconds = stopwatch.Lap();
  summary.edge_seconds = 0;
  summary.vertices = std::ssize(sampled.quadruples);
  summary.components = sampled.components;
  summary.edges = {{"concurrent-concurrent", std::ssize(sampled.links)}};
  summary.types = {{"concurrent", graph.candidate_count(), summary.vertices, summary.vertices,
                    summary.components}};
  summary.unclear = 0;
  summary.sampling_share = CompareSampling(sampled, graph);
  return summary;
}

}  // namespace

PolyhedronPlanner::PolyhedronPlanner(PolyhedronGraph* graph)
    : planning::Planner({.name = "polyhedron",
                         .what = "concurrent grasps of four faces",
                         .in_space = planning::PlannerScope{hand::kFingersInSpace, {4, 4}, {4, 4}},
                         .options = {sets::kUniformSpanningOption, kFocusPointsOption}}),
      graph_(graph) {}

std::optional<MemoryNeed> PolyhedronPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimatePolyhedronGraph(SolidOf(request), request.criteria.friction_angle,
                                 sets::SpanningOf(request));
}

PolyhedronGraph& PolyhedronPlanner::GraphFor(const planning::PlanRequest& request,
                                             std::optional<PolyhedronGraph>& own) const {
  if (graph_ != nullptr) return *graph_;
  request.progress("searching quadruples of faces");
  return own.emplace(SolidOf(request), request.criteria.friction_angle, sets::SpanningOf(request),
                     request.deadline, request.progress);
}

planning::PlanResult PolyhedronPlanner::Plan(const planning::PlanRequest& request) const {
  std::optional<PolyhedronGraph> own;
  PolyhedronModel model(SolidOf(request), GraphFor(request, own), request);
  return sets::PlanOverSets(model, request, name());
}

planning::GraphSummary PolyhedronPlanner::SummarizeGraph(
    const planning::PlanRequest& request) const {
  std::optional<PolyhedronGraph> own;
  PolyhedronGraph& graph = GraphFor(request, own);
  planning::GraphSummary summary = sets::SummaryOf(graph, *request.object, name());
  if (request.parameters.Get<PolyhedronParameters>().focus_points > 0) {
    return SummarizeSampled(graph, request, std::move(summary));
  }
  summary.edges = {{"concurrent-concurrent", std::ssize(graph.switches())}};
  summary.types = {{"concurrent", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  summary.unclear = graph.unclear_count();
  return summary;
}

}  // namespace regrasp::polyhedron
