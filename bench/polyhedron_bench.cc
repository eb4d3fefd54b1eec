// Benchmark of the switching graph of solids. It measures the time for the cells and links of
// solids with many faces. Baselines are CGAL's exact linear programs and Nef polyhedra on the same
// combinations in the same run. The program also measures how time and memory grow with the size of
// the result.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "bench/polyhedron_nef.h"
#include "bench/polyhedron_program.h"
#include "bench/polyhedron_query.h"
#include "bench/polyhedron_stone.h"
#include "planner/base/number.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace {

using namespace regrasp;
using Eigen::Vector3d;

constexpr int kFaces = 47;
constexpr double kDegrees = 10;
constexpr int kRuns = 15;  // the minimum time counts
constexpr int kGrowthRuns = 3;
constexpr int kProgramSample = 40;
constexpr int kNefSample = 15;
constexpr int kQueries = 100;
constexpr unsigned kSeed = 1;
const Vector3d kRound(1, 1, 1);
const Vector3d kStretched(2.5, 1, 0.6);

constexpr double kMillisecondsPerSecond = 1e3;
constexpr double kNanosecondsPerMillisecond = 1e6;

struct NamedSolid {
  std::string name;
  object::Polyhedron solid;
};

/// Return random solids of 47 faces, and the models with at least as many faces.
std::vector<NamedSolid> Bodies() {
  std::vector<NamedSolid> bodies = {{"round stone", MakeStone(kFaces, kRound, kSeed)},
                                    {"stretched stone", MakeStone(kFaces, kStretched, kSeed)}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(REGRASP_MODELS)) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const object::ObjectFile model = object::ReadObject(file);
    if (model.object->face_count() < kFaces) continue;
    bodies.push_back(
        {file.stem().string(), dynamic_cast<const object::Polyhedron&>(*model.object)});
  }
  return bodies;
}

/// Graph of a solid: sizes, and the minimum times.
struct Timed {
  std::int64_t candidates = 0;
  int cells = 0;
  std::int64_t links = 0;
  int components = 0;
  std::int64_t unclear = 0;
  double mebibytes = 0;  ///< memory of the graph, MiB
  double cell_ms = std::numeric_limits<double>::infinity();
  double link_ms = std::numeric_limits<double>::infinity();
};

/// Return the memory in use.
double Mebibytes() {
  constexpr double kBytesPerMebibyte = 1 << 20;
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / kBytesPerMebibyte;
}

Timed TimeGraph(const object::Polyhedron& solid, double degrees, planning::Spanning spanning,
                int runs) {
  Timed timed;
  for (int run = 0; run < runs; ++run) {
    const double before = Mebibytes();
    const polyhedron::PolyhedronGraph graph(solid, Radians(degrees), spanning);
    timed.mebibytes = Mebibytes() - before;
    timed.cell_ms = std::min(timed.cell_ms, kMillisecondsPerSecond * graph.vertex_seconds());
    timed.link_ms = std::min(timed.link_ms, kMillisecondsPerSecond * graph.edge_seconds());
    timed.candidates = graph.candidate_count();
    timed.cells = graph.vertex_count();
    timed.links = std::ssize(graph.switches());
    timed.components = graph.components().count();
    timed.unclear = graph.unclear_count();
  }
  return timed;
}

double NanosecondsPer(double milliseconds, std::int64_t count) {
  return kNanosecondsPerMillisecond * milliseconds /
         static_cast<double>(std::max<std::int64_t>(count, 1));
}

const char* NameOf(planning::Spanning spanning) {
  return spanning == planning::Spanning::kUniform ? "uniform" : "adaptive";
}

void PrintHeader(const char* first) {
  std::printf("%-18s %5s %4s %-8s %10s %8s %9s %5s %7s %9s %9s %9s %9s %9s", first, "faces", "deg",
              "spanning", "candidates", "cells", "links", "comp", "unclear", "cells ms", "links ms",
              "ns/cand", "ns/cell", "ns/link");
}

void PrintGraph(const std::string& name, int faces, double degrees, planning::Spanning spanning,
                const Timed& t) {
  std::printf("%-18s %5d %4g %-8s %10lld %8d %9lld %5d %7lld %9.2f %9.2f %9.0f %9.0f %9.0f",
              name.c_str(), faces, degrees, NameOf(spanning), static_cast<long long>(t.candidates),
              t.cells, static_cast<long long>(t.links), t.components,
              static_cast<long long>(t.unclear), t.cell_ms, t.link_ms,
              NanosecondsPer(t.cell_ms, t.candidates), NanosecondsPer(t.cell_ms, t.cells),
              NanosecondsPer(t.link_ms, t.links));
}

void PrintBodies(const std::vector<NamedSolid>& bodies) {
  PrintHeader("body");
  std::printf("\n");
  for (const auto& [name, solid] : bodies) {
    for (const planning::Spanning spanning :
         {planning::Spanning::kUniform, planning::Spanning::kAdaptive}) {
      PrintGraph(name, solid.face_count(), kDegrees, spanning,
                 TimeGraph(solid, kDegrees, spanning, kRuns));
      std::printf("\n");
    }
  }
}

/// Return candidates of a solid, a random sample if there are many.
std::vector<polyhedron::QuadrupleCandidate> SampleCandidates(const object::Polyhedron& solid,
                                                             int most) {
  std::vector<Vector3d> normals;
  for (FaceIndex f{0}; f < solid.face_count(); ++f) normals.push_back(solid.inward_normal(f));
  auto candidates = polyhedron::FindQuadrupleCandidates(normals, std::tan(Radians(kDegrees)),
                                                        planning::Spanning::kUniform);
  std::mt19937_64 engine(kSeed);
  for (std::size_t i = candidates.size(); i > 1; --i) {
    std::swap(candidates[i - 1], candidates[engine() % i]);
  }
  if (std::ssize(candidates) > most) candidates.resize(most);
  return candidates;
}

/// Return the processor time, which other programs do not affect.
double MillisecondsOf(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return kMillisecondsPerSecond * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Measure the cell finder on some candidates. Each run uses a new finder, so that the time
/// includes its cache of pairs.
double TimeFinder(const object::Polyhedron& solid,
                  const std::vector<polyhedron::QuadrupleCandidate>& candidates, int& cells) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    polyhedron::FocusCellFinder finder(solid, std::tan(Radians(kDegrees)));
    cells = 0;
    least = std::min(least, MillisecondsOf([&] {
                       for (const auto& candidate : candidates) {
                         if (!finder.Find(candidate).empty()) ++cells;
                       }
                     }));
  }
  return least;
}

/// Sixteen programs per combination: each face is seen from its inner and its outer side.
bool HasCellByPrograms(const polyhedron::FaceParts& parts,
                       const polyhedron::QuadrupleCandidate& candidate) {
  constexpr int kPatterns = 16;
  bool has = false;
  for (int pattern = 0; pattern < kPatterns; ++pattern) {
    std::array<int, 4> halves;
    for (int k = 0; k < 4; ++k) {
      halves[k] = 2 * parts.first[candidate.faces[k]] + (pattern >> k & 1);
    }
    has = HasPieceByProgram(parts, halves, candidate.tangent) || has;
  }
  return has;
}

void PrintComparison(const char* baseline, int combinations, int cells, int by_baseline, double ms,
                     double baseline_ms) {
  std::printf(
      "  %s: %d combinations; %.3f us each (%d cells), %.0f us each (%d cells); %.0f times\n",
      baseline, combinations, kMillisecondsPerSecond * ms / combinations, cells,
      kMillisecondsPerSecond * baseline_ms / combinations, by_baseline, baseline_ms / ms);
}

/// Solids with non-convex faces are omitted, because the baselines treat each face as one part.
void CompareWithBaselines(const NamedSolid& body) {
  const polyhedron::FaceParts parts = polyhedron::SplitFaces(body.solid);
  if (std::ssize(parts.parts) != body.solid.face_count()) return;
  std::printf("%s\n", body.name.c_str());
  int cells = 0, by_baseline = 0;
  const auto for_programs = SampleCandidates(body.solid, kProgramSample);
  double ms = TimeFinder(body.solid, for_programs, cells);
  double baseline_ms = MillisecondsOf([&] {
    for (const auto& candidate : for_programs) by_baseline += HasCellByPrograms(parts, candidate);
  });
  PrintComparison("exact linear programs", static_cast<int>(for_programs.size()), cells,
                  by_baseline, ms, baseline_ms);
  const auto for_nef = SampleCandidates(body.solid, kNefSample);
  std::vector<int> faces;
  for (const auto& candidate : for_nef) {
    faces.insert(faces.end(), candidate.faces.begin(), candidate.faces.end());
  }
  const NefVolumes volumes(body.solid, parts, faces, std::tan(Radians(kDegrees)));
  ms = TimeFinder(body.solid, for_nef, cells);
  by_baseline = 0;
  baseline_ms = MillisecondsOf([&] {
    for (const auto& candidate : for_nef) by_baseline += volumes.HasCell(candidate.faces);
  });
  PrintComparison("Nef intersection", static_cast<int>(for_nef.size()), cells, by_baseline, ms,
                  baseline_ms);
}

void PrintGrowth(double degrees, const Vector3d& stretch, const std::vector<int>& face_counts) {
  PrintHeader(stretch == kRound ? "growth, round" : "growth, stretched");
  std::printf(" %9s\n", "MiB");
  for (const int faces : face_counts) {
    const object::Polyhedron solid = MakeStone(faces, stretch, kSeed);
    const Timed timed = TimeGraph(solid, degrees, planning::Spanning::kUniform, kGrowthRuns);
    PrintGraph("", faces, degrees, planning::Spanning::kUniform, timed);
    std::printf(" %9.1f\n", timed.mebibytes);
    std::fflush(stdout);
  }
}

void PrintQueries(const std::string& model) {
  const object::ObjectFile file =
      object::ReadObject(std::filesystem::path(REGRASP_MODELS) / (model + ".obj"));
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*file.object);
  std::printf("%-10s %4s %-8s %7s %8s %8s %8s %8s %9s %9s\n", "queries", "deg", "spanning",
              "queries", "no plan", "warning", "switches", "mean ms", "median ms", "most ms");
  for (const auto& [degrees, spanning] : {std::pair(10.0, planning::Spanning::kUniform),
                                          std::pair(20.0, planning::Spanning::kAdaptive)}) {
    const QueryTimes t = TimeQueries(solid, degrees, spanning, kQueries);
    std::printf("%-10s %4g %-8s %7d %8d %8d %8.1f %8.2f %9.2f %9.2f\n", model.c_str(), degrees,
                NameOf(spanning), t.queries, t.without_plan, t.with_warning, t.mean_switches,
                t.mean_ms, t.median_ms, t.most_ms);
    std::fflush(stdout);
  }
}

void TimeWholeGraph(benchmark::State& state, const Vector3d& stretch) {
  const object::Polyhedron solid = MakeStone(kFaces, stretch, kSeed);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        polyhedron::PolyhedronGraph(solid, Radians(kDegrees), planning::Spanning::kUniform));
  }
}
BENCHMARK_CAPTURE(TimeWholeGraph, round, kRound)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(TimeWholeGraph, stretched, kStretched)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::vector<NamedSolid> bodies = Bodies();
  PrintQueries("body67");
  std::printf("\n");
  PrintBodies(bodies);
  std::printf("\npyramids of eight sides, %g degrees, uniform\n", kDegrees);
  for (const NamedSolid& body : bodies) CompareWithBaselines(body);
  std::printf("\n");
  PrintGrowth(15, kStretched, {20, 50, 100, 200, 300, 500});
  PrintGrowth(15, kRound, {20, 50, 100, 200, 300, 500});
  PrintGrowth(kDegrees, kRound, {20, 50, 100, 200});
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
