// Benchmark of the switching graph of a whole boundary. It measures the time for the sets and the
// switches of polygons with many edges, with CGAL's exact union of the same pieces in the same run
// as baseline. It also measures how time grows with the size of the result.

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
#include <string>
#include <vector>

#include "bench/contour_union.h"
#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/contour/region_diagram.h"

namespace {

using namespace regrasp;

constexpr double kDegrees[] = {10, 15, 20};
constexpr int kGraphRuns = 15;  // the minimum time counts
constexpr int kUnionRuns = 5;
constexpr int kManyEdges = 100;
constexpr int kOutlineEdges = 300;
constexpr int kGrowthRuns = 5;
constexpr std::uint64_t kSeed = 1;

/// Return a smooth simple outline about the origin.
/// It is the sum of seven waves with random amplitudes and phases and five to eleven periods, in
/// total at most 0.45 of the radius.
object::Polygon LobedOutline(int edges) {
  constexpr int kWaves = 7;
  constexpr int kFirstWave = 5;
  constexpr double kHeight = 0.45;
  std::mt19937_64 engine(kSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> heights, phases;
  for (int w = 0; w < kWaves; ++w) {
    heights.push_back(kHeight / kWaves * unit(engine));
    phases.push_back(2 * std::numbers::pi * unit(engine));
  }
  std::vector<Eigen::Vector2d> ring;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * k / edges;
    double r = 1;
    for (int w = 0; w < kWaves; ++w) {
      r += heights[w] * std::cos((kFirstWave + w) * angle + phases[w]);
    }
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return object::Polygon::FromRings({ring}, "lobed outline");
}

/// Graph of a polygon: sizes, and the minimum times.
struct Timed {
  int vertices = 0;
  std::int64_t switches = 0;
  int components = 0;
  std::int64_t candidates = 0;
  std::int64_t combinations = 0;
  double vertex_ms = std::numeric_limits<double>::infinity();
  double edge_ms = std::numeric_limits<double>::infinity();
};

Timed TimeGraph(const object::Polygon& polygon, double degrees, int runs) {
  constexpr double kMilliseconds = 1e3;
  Timed timed;
  for (int run = 0; run < runs; ++run) {
    const contour::ContourGraph graph(polygon, Radians(degrees));
    timed.vertex_ms = std::min(timed.vertex_ms, kMilliseconds * graph.vertex_seconds());
    timed.edge_ms = std::min(timed.edge_ms, kMilliseconds * graph.edge_seconds());
    timed.vertices = graph.vertex_count();
    timed.switches = std::ssize(graph.switches());
    timed.components = graph.components().count();
    timed.candidates = graph.candidate_count();
    timed.combinations = graph.combination_count();
  }
  return timed;
}

/// Compute the L-infinity Voronoi diagrams of all sets in one run.
double TimeDiagrams(const object::Polygon& polygon, double degrees) {
  const contour::ContourGraph graph(polygon, Radians(degrees));
  const auto start = std::chrono::steady_clock::now();
  for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
    benchmark::DoNotOptimize(contour::RegionMetric(graph, set).MakeDiagram());
  }
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  return time.count();
}

void PrintModel(const std::string& name, const object::Polygon& polygon) {
  for (const double degrees : kDegrees) {
    const Timed t = TimeGraph(polygon, degrees, kGraphRuns);
    std::printf("%-18s %5d %4g %10lld %10lld %7d %7lld %5d %10.2f %10.2f %12.0f\n", name.c_str(),
                polygon.face_count(), degrees, static_cast<long long>(t.candidates),
                static_cast<long long>(t.combinations), t.vertices,
                static_cast<long long>(t.switches), t.components, t.vertex_ms, t.edge_ms,
                TimeDiagrams(polygon, degrees));
  }
}

/// Print the random outline, and the models with many edges.
void PrintModels() {
  std::printf("%-18s %5s %4s %10s %10s %7s %7s %5s %10s %10s %12s\n", "polygon", "edges", "deg",
              "candidates", "graspable", "sets", "switch", "comp", "sets ms", "switch ms",
              "diagrams ms");
  PrintModel("lobed outline", LobedOutline(kOutlineEdges));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(REGRASP_MODELS)) {
    if (entry.path().extension() == ".wkt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const object::ObjectFile model = object::ReadObject(file);
    if (model.object->face_count() < kManyEdges) continue;
    PrintModel(file.stem().string(), dynamic_cast<const object::Polygon&>(*model.object));
  }
}

void CompareWithUnion(const object::Polygon& polygon, double degrees) {
  const Timed timed = TimeGraph(polygon, degrees, kGraphRuns);
  const contour::ContourGraph graph(polygon, Radians(degrees));
  const PieceOutlines outlines = MakePieceOutlines(graph);
  std::vector<UnionComponent> components;
  std::chrono::duration<double, std::milli> time{std::numeric_limits<double>::infinity()};
  for (int run = 0; run < kUnionRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    components = Unite(outlines.outlines);
    time = std::min<decltype(time)>(time, std::chrono::steady_clock::now() - start);
  }
  std::printf(
      "%g degrees: %zu pieces; sets %.2f ms, candidates and pieces included (%d sets); "
      "Polygon_set_2, union alone %.0f ms (%zu polygons, %d when glued at the ring's start); "
      "%.0f times\n",
      degrees, graph.pieces().size(), timed.vertex_ms, timed.vertices, time.count(),
      components.size(), CountGlued(graph, outlines, components), time.count() / timed.vertex_ms);
}

void PrintGrowth(double degrees) {
  std::printf("%g degrees\n%6s %11s %11s %7s %9s %10s %10s %14s %14s\n", degrees, "edges",
              "candidates", "graspable", "sets", "switches", "sets ms", "switch ms", "sets ns/pair",
              "switch ns/pair");
  for (const int edges : {20, 50, 100, 200, 300, 500, 1000, 2000, 5000}) {
    const Timed t = TimeGraph(LobedOutline(edges), degrees, kGrowthRuns);
    constexpr double kNanoseconds = 1e6;
    const double pairs = static_cast<double>(std::max<std::int64_t>(t.combinations, 1));
    std::printf("%6d %11lld %11lld %7d %9lld %10.2f %10.2f %14.0f %14.0f\n", edges,
                static_cast<long long>(t.candidates), static_cast<long long>(t.combinations),
                t.vertices, static_cast<long long>(t.switches), t.vertex_ms, t.edge_ms,
                kNanoseconds * t.vertex_ms / pairs, kNanoseconds * t.edge_ms / pairs);
  }
}

void TimeWholeGraph(benchmark::State& state) {
  const object::Polygon polygon = LobedOutline(kOutlineEdges);
  const double friction_angle = Radians(static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(contour::ContourGraph(polygon, friction_angle));
}
BENCHMARK(TimeWholeGraph)
    ->Name("graph, 300 edges")
    ->Arg(10)
    ->Arg(15)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  PrintModels();
  std::printf("\nlobed outline of %d edges\n", kOutlineEdges);
  for (const double degrees : kDegrees) CompareWithUnion(LobedOutline(kOutlineEdges), degrees);
  std::printf("\n");
  PrintGrowth(kDegrees[0]);
  PrintGrowth(kDegrees[2]);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
