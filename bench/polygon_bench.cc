// Benchmark of the switching graph of polygons: all types, vertices and edges. The baseline is
// CGAL's exact Boolean operations on polygons for the focus cells alone, in the same run. The
// program also measures how time grows with the size of the result.

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "bench/polygon_set_cells.h"
#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace {

using namespace regrasp;

constexpr double kDegrees = 10;
constexpr int kGraphRuns = 15;  // the minimum time counts
constexpr int kCellRuns = 3;
/// Reach, in edge lengths: no uniform cell of the model extends so far, so the count is the same.
constexpr double kBenchReach = 0x1p10;

const object::Polygon& Model() {
  static const object::ObjectFile file =
      object::ReadObject(std::filesystem::path(REGRASP_MODELS) / "polygon40.wkt");
  return dynamic_cast<const object::Polygon&>(*file.object);
}

template <typename Work>
double FastestMilliseconds(int runs, const Work& work) {
  double fastest = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    fastest = std::min(fastest, time.count());
  }
  return fastest;
}

polygon::PolygonGraph Graph(const object::Polygon& polygon, planning::Spanning spanning) {
  return polygon::PolygonGraph(polygon, Radians(kDegrees), spanning);
}

std::int64_t EdgeCount(const polygon::PolygonGraph& graph) {
  std::int64_t count = 0;
  for (const polygon::GraspType a :
       {polygon::GraspType::kConcurrent, polygon::GraspType::kTwoFinger,
        polygon::GraspType::kParallel}) {
    for (const polygon::GraspType b :
         {polygon::GraspType::kConcurrent, polygon::GraspType::kTwoFinger,
          polygon::GraspType::kParallel}) {
      if (a <= b) count += graph.edge_count(a, b);
    }
  }
  return count;
}

void CompareWithSetOperations(planning::Spanning spanning) {
  const bool uniform = spanning == planning::Spanning::kUniform;
  const auto candidates = uniform ? FindUniformCandidates(Model(), Radians(kDegrees))
                                  : FindAdaptiveCandidates(Model(), Radians(kDegrees));
  const double reach = uniform ? kBenchReach : kCellReach;
  std::size_t cells = 0;
  const double baseline = FastestMilliseconds(
      kCellRuns, [&] { cells = FindSetCells(Model(), candidates, reach).size(); });
  const polygon::PolygonGraph graph = Graph(Model(), spanning);
  const double ours =
      FastestMilliseconds(kGraphRuns, [&] { benchmark::DoNotOptimize(Graph(Model(), spanning)); });
  std::printf(
      "%s: graph %.2f ms (%d vertices, %lld edges, all types); Polygon_set_2, focus cells alone "
      "%.1f ms (%zu cells, graph has %lld); %.0f times\n",
      uniform ? "uniform " : "adaptive", ours, graph.vertex_count(),
      static_cast<long long>(EdgeCount(graph)), baseline, cells,
      static_cast<long long>(graph.counts(polygon::GraspType::kConcurrent).vertices),
      baseline / ours);
}

/// Return a simple polygon about the origin, with perturbed angles and radii between 0.6 and 1.
object::Polygon IrregularPolygon(int edges) {
  std::mt19937_64 engine(edges);
  std::uniform_real_distribution<double> shake(-0.4, 0.4);
  std::uniform_real_distribution<double> radius(0.6, 1);
  std::vector<Eigen::Vector2d> ring;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * (k + shake(engine)) / edges;
    const double r = radius(engine);
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return object::Polygon::FromRings({ring}, "irregular polygon");
}

void PrintGrowth(planning::Spanning spanning) {
  std::printf("%s\n%6s %10s %12s %12s %12s %12s %10s\n",
              spanning == planning::Spanning::kUniform ? "uniform" : "adaptive", "edges",
              "vertices", "switches", "vertices ms", "switches ms", "us/vertex", "ns/switch");
  for (const int edges : {15, 20, 30, 40, 60, 80, 100, 150, 200}) {
    const object::Polygon polygon = IrregularPolygon(edges);
    double vertices = std::numeric_limits<double>::infinity();
    double switches = vertices;
    int vertex_count = 0;
    std::int64_t edge_count = 0;
    for (int run = 0; run < (edges > 60 ? 1 : kGraphRuns); ++run) {
      const polygon::PolygonGraph graph = Graph(polygon, spanning);
      vertices = std::min(vertices, graph.vertex_seconds());
      switches = std::min(switches, graph.edge_seconds());
      vertex_count = graph.vertex_count();
      edge_count = EdgeCount(graph);
    }
    std::printf("%6d %10d %12lld %12.2f %12.2f %12.2f %10.1f\n", edges, vertex_count,
                static_cast<long long>(edge_count), 1e3 * vertices, 1e3 * switches,
                1e6 * vertices / vertex_count, 1e9 * switches / static_cast<double>(edge_count));
  }
}

template <planning::Spanning kSpanning>
void TimeGraph(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Graph(Model(), kSpanning));
}
BENCHMARK(TimeGraph<planning::Spanning::kUniform>)
    ->Name("graph, uniform")
    ->Unit(benchmark::kMillisecond);
BENCHMARK(TimeGraph<planning::Spanning::kAdaptive>)
    ->Name("graph, adaptive")
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::printf("polygon40.wkt at %g degrees\n", kDegrees);
  CompareWithSetOperations(planning::Spanning::kUniform);
  CompareWithSetOperations(planning::Spanning::kAdaptive);
  benchmark::RunSpecifiedBenchmarks();
  PrintGrowth(planning::Spanning::kUniform);
  PrintGrowth(planning::Spanning::kAdaptive);
  return 0;
}
