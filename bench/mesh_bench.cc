// Benchmark of the planner for triangle meshes: clustering, the decision on all subsets of the
// representatives, and queries. The baseline of the subsets is one linear program of GLPK for each
// of a sample of them, with friction cones as pyramids with eight sides.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>

#include "bench/pyramid_force_closure.h"
#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/subset_force_closure.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/roadmap_planner.h"

namespace {

using namespace regrasp;

constexpr double kDegrees = 10;
constexpr int kQueries = 30;
constexpr std::uint64_t kSeed = 1;
constexpr std::array kBodies = {"ellipsoid1000", "flask1000", "mug1000",
                                "spanner1000",   "star1000",  "duck1000"};

const object::Polyhedron& Body(std::int64_t index) {
  static std::map<std::int64_t, object::ObjectFile> files;
  const auto [entry, is_new] = files.try_emplace(index);
  if (is_new) {
    entry->second = object::ReadObject(std::filesystem::path(REGRASP_MODELS) /
                                       (kBodies.at(index) + std::string(".obj")));
  }
  return dynamic_cast<const object::Polyhedron&>(*entry->second.object);
}

roadmap::ClusteredRoadmapOptions Options(int clusters) {
  roadmap::ClusteredRoadmapOptions options;
  options.friction_angle = Radians(kDegrees);
  options.clusters = clusters;
  return options;
}

const roadmap::ClusteredRoadmap& RoadmapOf(std::int64_t index, int clusters) {
  static std::map<std::pair<std::int64_t, int>, std::unique_ptr<roadmap::ClusteredRoadmap>>
      roadmaps;
  std::unique_ptr<roadmap::ClusteredRoadmap>& roadmap = roadmaps[{index, clusters}];
  if (!roadmap)
    roadmap = std::make_unique<roadmap::ClusteredRoadmap>(Body(index), Options(clusters));
  return *roadmap;
}

/// Compute affinities, embedding, k-means and representatives of a thousand contact points.
void BM_Cluster(benchmark::State& state) {
  const object::Polyhedron& solid = Body(state.range(0));
  const int clusters = static_cast<int>(state.range(1));
  const std::vector<grasp::Contact> contacts =
      RoadmapOf(state.range(0), clusters).clusters.contacts();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        roadmap::ContactClusters(contacts, solid.wrench_frame(), Radians(kDegrees), clusters, 0));
  }
  state.SetLabel(kBodies.at(state.range(0)));
  state.counters["contacts"] = static_cast<double>(contacts.size());
}

/// Test all subsets of four representatives.
void BM_Subsets(benchmark::State& state) {
  const roadmap::ClusteredRoadmap& roadmap =
      RoadmapOf(state.range(0), static_cast<int>(state.range(1)));
  grasp::SubsetCounts counts;
  for (auto _ : state) {
    benchmark::DoNotOptimize(grasp::ForceClosureSubsets(roadmap.roadmap.points(), roadmap.frame,
                                                        roadmap.friction_angle, &counts));
  }
  state.SetLabel(kBodies.at(state.range(0)));
  state.counters["subsets"] = static_cast<double>(counts.subsets);
  state.counters["by_simplex"] = static_cast<double>(counts.by_simplex);
  state.counters["vertices"] = roadmap.roadmap.vertex_count();
  state.counters["per_subset"] = benchmark::Counter(
      static_cast<double>(counts.subsets),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Solve a linear program for each of a sample of the same subsets.
void BM_SubsetsByGlpk(benchmark::State& state) {
  const roadmap::ClusteredRoadmap& roadmap =
      RoadmapOf(state.range(0), static_cast<int>(state.range(1)));
  const std::vector<grasp::Contact>& points = roadmap.roadmap.points();
  RandomStream random(kSeed, RandomUse::kStart);
  std::int64_t asked = 0;
  for (auto _ : state) {
    grasp::Grasp grasp;
    for (int i = 0; i < 4; ++i) {
      grasp::Contact contact = points[random.Index(points.size())];
      contact.p = (contact.p - roadmap.frame.origin) / roadmap.frame.radius;
      grasp.push_back(contact);
    }
    benchmark::DoNotOptimize(PyramidForceClosure(grasp, roadmap.friction_angle));
    ++asked;
  }
  state.SetLabel(kBodies.at(state.range(0)));
  state.counters["per_subset"] = benchmark::Counter(
      static_cast<double>(asked), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Run thirty queries between random force-closure grasps of all contact points.
void BM_Queries(benchmark::State& state) {
  const roadmap::ClusteredRoadmap& roadmap =
      RoadmapOf(state.range(0), static_cast<int>(state.range(1)));
  const object::Polyhedron& solid = Body(state.range(0));
  double seconds = 0;
  double longest = 0;
  double joined = 0;
  double asked = 0;
  std::uint64_t seed = kSeed;
  for (auto _ : state) {
    for (const roadmap::RandomQuery& query :
         roadmap::RunRandomQueries(roadmap, solid, kQueries, seed++, /*last_resort=*/true)) {
      seconds += query.seconds;
      longest = std::max(longest, query.seconds);
      joined += query.chain.grasps.empty() ? 0 : 1;
      ++asked;
    }
  }
  state.SetLabel(kBodies.at(state.range(0)));
  state.counters["mean_ms"] = 1e3 * seconds / asked;
  state.counters["max_ms"] = 1e3 * longest;
  state.counters["joined"] = joined / asked;
}

/// Build a large roadmap, and report the maximum memory use of the program up to then.
void BM_LargeRoadmap(benchmark::State& state) {
  const object::Polyhedron& solid = Body(state.range(0));
  for (auto _ : state) {
    const roadmap::ClusteredRoadmap roadmap(solid, Options(static_cast<int>(state.range(1))));
    state.counters["vertices"] = roadmap.roadmap.vertex_count();
    state.counters["edges"] = static_cast<double>(roadmap.roadmap.CountEdges());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024;
  state.SetLabel(kBodies.at(state.range(0)));
}

const std::vector<std::int64_t> kAll = {0, 1, 2, 3, 4, 5};

BENCHMARK(BM_Cluster)->ArgsProduct({kAll, {70}})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Subsets)->ArgsProduct({kAll, {70}})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_SubsetsByGlpk)->ArgsProduct({kAll, {70}})->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_Queries)->ArgsProduct({kAll, {70}})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_LargeRoadmap)->ArgsProduct({{0, 3}, {150}})->Unit(benchmark::kMillisecond);

}  // namespace
