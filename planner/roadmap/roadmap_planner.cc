#include "planner/roadmap/roadmap_planner.h"

#include <algorithm>
#include <limits>
#include <string>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/stopwatch.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/graph_summary.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/cluster_search.h"
#include "planner/roadmap/contact_point_search.h"
#include "planner/roadmap/roadmap_memory.h"
#include "planner/roadmap/roadmap_queries.h"

namespace regrasp::roadmap {

namespace {

/// The part of the summary that does not depend on clusters.
/// @param stopwatch  that runs since the roadmap was begun.
planning::GraphSummary SummaryOf(const Roadmap& roadmap, const planning::PlanRequest& request,
                                 Stopwatch& stopwatch) {
  planning::GraphSummary summary;
  summary.planner = "roadmap";
  summary.face_name = "contact points";
  summary.vertex_seconds = stopwatch.Lap();
  request.progress("joining " + std::to_string(roadmap.vertex_count()) + " grasps");
  summary.faces = std::ssize(roadmap.points());
  summary.vertices = roadmap.vertex_count();
  summary.edges = {{"representative-representative", roadmap.CountEdges(request.deadline)}};
  summary.components = roadmap.FindComponents(request.deadline).count();
  summary.types = {{"representative", roadmap.candidate_count(), summary.vertices, summary.vertices,
                    summary.components}};
  summary.edge_seconds = stopwatch.Lap();
  return summary;
}

planning::QuerySummary RunQueries(const ClusteredRoadmap& roadmap, int count,
                                  const planning::PlanRequest& request) {
  planning::QuerySummary summary;
  summary.shortest_seconds = std::numeric_limits<double>::infinity();
  for (const RandomQuery& query :
       RunRandomQueries(roadmap, dynamic_cast<const object::Polyhedron&>(*request.object), count,
                        request.seed, request.last_resort, request.deadline, request.progress)) {
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

}  // namespace

RoadmapPlanner::RoadmapPlanner()
    : planning::Planner(
          {.name = "roadmap",
           .what = "grasps of contact points or clusters of them",
           .in_space = planning::PlannerScope{kRoadmapFingers,
                                              {kRoadmapContacts, kRoadmapContacts},
                                              {kRoadmapContacts, kRoadmapContacts}},
           .options = {planning::PlanOption::kContactPoints, planning::PlanOption::kGivenPoints,
                       planning::PlanOption::kClusters, planning::PlanOption::kNoLastResort,
                       planning::PlanOption::kQueries}}) {}

std::optional<MemoryNeed> RoadmapPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimateRoadmap(request);
}

planning::PlanResult RoadmapPlanner::Plan(const planning::PlanRequest& request) const {
  if (SizeOf(request).clusters > 0) return SearchClusters(request);
  return SearchContactPoints(SpreadContacts(request), request);
}

planning::GraphSummary RoadmapPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const int queries = request.graph ? request.graph->queries : 0;
  Stopwatch stopwatch;
  if (SizeOf(request).clusters == 0) {
    if (queries > 0) throw InputError("--queries: needs a roadmap of clusters (--clusters)");
    return SummaryOf(BuildRoadmap(request, SpreadContacts(request)), request, stopwatch);
  }
  const ClusteredRoadmap clustered = BuildClusteredRoadmap(request);
  planning::GraphSummary summary = SummaryOf(clustered.roadmap, request, stopwatch);
  summary.faces = clustered.clusters.clustered_count();
  summary.clusters = clustered.clusters.cluster_count();
  if (queries > 0) summary.queries = RunQueries(clustered, queries, request);
  return summary;
}

}  // namespace regrasp::roadmap
