#include "planner/roadmap/roadmap_planner.h"

#include <algorithm>
#include <limits>
#include <string>

#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/planner.h"
#include "planner/roadmap/cluster_search.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::roadmap {

namespace {

constexpr int kContacts = 4;

/// Number of tested grasps. They take a few hundredths of a second and give a share of 0.1 to 7 %.
constexpr int kTestedGrasps = 2000;

// Measured as the peak resident memory of roadmaps with 60 to 200 contact points at 15° to 80°. A
// vertex includes its entries in the lists of triples, its component and its search data. A triple
// includes its entry in these lists.
constexpr double kBytesOfVertex = 55;
constexpr double kBytesOfTriple = 8;

/// Bytes per pair of clustered contact points, for distance, affinity and the matrix of the
/// eigenvalue problem. Measurements gave 26 to 28 for 1000 to 4000 contact points.
constexpr double kBytesOfPair = 27;

double ForceClosureShare(const object::Polyhedron& solid, double friction_angle) {
  const sampling::SurfaceSampler sampler(solid);
  RandomStream random(0, RandomUse::kContactPoints);
  int count = 0;
  for (int i = 0; i < kTestedGrasps; ++i) {
    grasp::Grasp grasp;
    for (int k = 0; k < kContacts; ++k) grasp.push_back(sampler.DrawAnywhere(random));
    if (grasp::IsForceClosure(grasp, solid.wrench_frame(), friction_angle)) ++count;
  }
  return static_cast<double>(count) / kTestedGrasps;
}

MemoryNeed EstimateGrasps(const object::Polyhedron& solid, double friction_angle, int points,
                          const std::string& units) {
  const double share = ForceClosureShare(solid, friction_angle);
  const auto bytes_for = [share](int n) {
    return kBytesOfVertex * share * static_cast<double>(Binomial<kContacts>(n)) +
           kBytesOfTriple * static_cast<double>(Binomial<3>(n));
  };
  return {"the graph of the planner roadmap", points, units, bytes_for};
}

}  // namespace

MemoryNeed EstimateRoadmap(const planning::PlanRequest& request) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*request.object);
  const RoadmapSize size = SizeOf(request);
  const double friction_angle = request.criteria.friction_angle;
  if (size.clusters == 0) {
    return EstimateGrasps(solid, friction_angle, size.contacts, "contact points");
  }
  MemoryNeed grasps = EstimateGrasps(solid, friction_angle, size.clusters, "clusters");
  MemoryNeed clustering = {"the clustering of the planner roadmap", size.contacts, "contact points",
                           [](double n) { return kBytesOfPair * n * n; }};
  return clustering.bytes() > grasps.bytes() ? clustering : grasps;
}

std::optional<Quadruple> DrawContactGrasp(const ClusteredRoadmap& roadmap,
                                          const criteria::GraspEvaluator& evaluator,
                                          RandomStream& random) {
  const std::vector<grasp::Contact>& contacts = roadmap.clusters.contacts();
  for (int draw = 0; draw < sampling::kMaxSurfaceDraws; ++draw) {
    Quadruple numbers;
    for (int& contact : numbers) contact = static_cast<int>(random.Index(contacts.size()));
    std::sort(numbers.begin(), numbers.end());
    grasp::Grasp grasp;
    for (const int contact : numbers) grasp.push_back(contacts[contact]);
    if (evaluator.IsAdmitted(grasp)) return numbers;
  }
  return std::nullopt;
}

std::vector<RandomQuery> RunRandomQueries(const ClusteredRoadmap& roadmap,
                                          const object::Polyhedron& solid, int count,
                                          std::uint64_t seed, bool last_resort,
                                          const Deadline& deadline, const Tell& tell) {
  const criteria::GraspCriteria force_closure = {roadmap.friction_angle, 0};
  const criteria::GraspEvaluator evaluator(solid, force_closure);
  RandomStream starts(seed, RandomUse::kStart);
  RandomStream goals(seed, RandomUse::kGoal);
  std::vector<RandomQuery> queries;
  CountedProgress progress(tell, "random queries", count);
  for (int i = 0; i < count; ++i) {
    deadline.Check();
    progress.Add();
    const auto start = DrawContactGrasp(roadmap, evaluator, starts);
    const auto goal = DrawContactGrasp(roadmap, evaluator, goals);
    if (!start || !goal) break;
    Stopwatch stopwatch;
    GraspOracle oracle(solid, roadmap.clusters.contacts(), force_closure, {}, deadline);
    ContactChain chain =
        FindContactChain(roadmap, roadmap.clusters, oracle, *start, *goal, last_resort);
    queries.push_back({*start, *goal, std::move(chain), stopwatch.Lap()});
  }
  return queries;
}

namespace {

/// Return the part of the summary that does not depend on clusters.
/// @param stopwatch  stopwatch started before the roadmap was built.
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
                        request.seed, request.parameters.Get<RoadmapParameters>().last_resort,
                        request.deadline, request.progress)) {
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
    : planning::Planner({.name = "roadmap",
                         .what = "grasps of contact points or clusters of them",
                         .in_space = planning::PlannerScope{kRoadmapFingers,
                                                            {kRoadmapContacts, kRoadmapContacts},
                                                            {kRoadmapContacts, kRoadmapContacts}},
                         .options = {kContactsOption, planning::kGivenPointsOption, kClustersOption,
                                     kNoLastResortOption, kQueriesOption}}) {}

std::optional<MemoryNeed> RoadmapPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimateRoadmap(request);
}

planning::PlanResult RoadmapPlanner::Plan(const planning::PlanRequest& request) const {
  if (SizeOf(request).clusters > 0) return SearchClusters(request);
  return SearchContactPoints(SpreadContacts(request), request);
}

planning::GraphSummary RoadmapPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const int queries = request.parameters.Get<RoadmapParameters>().queries;
  Stopwatch stopwatch;
  if (SizeOf(request).clusters == 0) {
    if (queries > 0) throw InputError("--planner queries requires clusters");
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
