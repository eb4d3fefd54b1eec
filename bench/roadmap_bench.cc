// Benchmark of building the plain roadmap and of planning on it. The baseline runs the
// force-closure test on every subset, one after the other.

#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/solve.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_planner.h"
#include "planner/sampling/contact_points.h"

namespace {

using namespace regrasp;

constexpr double kFrictionAngleDegrees = 20;

/// Measured models: a block with opposite contacts, and a convex solid with irregular faces, whose
/// contacts are rarely opposite.
constexpr std::array<const char*, 2> kModels = {"cube.obj", "stone.obj"};

const object::Polyhedron& Model(std::int64_t index) {
  static std::array<object::ObjectFile, kModels.size()> files = [] {
    std::array<object::ObjectFile, kModels.size()> read;
    for (std::size_t i = 0; i < kModels.size(); ++i) {
      read[i] = object::ReadObject(std::filesystem::path(REGRASP_MODELS) / kModels[i]);
    }
    return read;
  }();
  return dynamic_cast<const object::Polyhedron&>(*files.at(index).object);
}

planning::PlanRequest RequestFor(const object::Polyhedron& solid, std::int64_t contacts) {
  return {.object = &solid,
          .criteria = {.friction_angle = Radians(kFrictionAngleDegrees)},
          .parameters = roadmap::RoadmapParameters{.contact_points = static_cast<int>(contacts)}};
}

void Describe(benchmark::State& state, std::int64_t subsets, std::int64_t vertices) {
  state.SetLabel(kModels.at(state.range(0)));
  state.counters["subsets"] = static_cast<double>(subsets);
  state.counters["vertices"] = static_cast<double>(vertices);
}

/// Measure a roadmap whose subsets are each tested alone.
void BM_TestEverySubset(benchmark::State& state) {
  const object::Polyhedron& solid = Model(state.range(0));
  const planning::PlanRequest request = RequestFor(solid, state.range(1));
  const std::vector<grasp::Contact> p =
      sampling::SpreadContactPoints(solid, static_cast<int>(state.range(1)), request.seed);
  const object::WrenchFrame frame = solid.wrench_frame();
  const int count = static_cast<int>(p.size());
  std::int64_t subsets = 0;
  std::int64_t vertices = 0;
  for (auto _ : state) {
    subsets = vertices = 0;
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        for (int c = b + 1; c < count; ++c) {
          for (int d = c + 1; d < count; ++d) {
            const std::array<grasp::Contact, 4> grasp = {p[a], p[b], p[c], p[d]};
            ++subsets;
            vertices +=
                grasp::IsForceClosure(grasp, frame, request.criteria.friction_angle) ? 1 : 0;
          }
        }
      }
    }
  }
  Describe(state, subsets, vertices);
}

/// Measure sampling of the points, finding all vertices, and indexing them by their triples.
void BM_BuildRoadmap(benchmark::State& state) {
  const object::Polyhedron& solid = Model(state.range(0));
  const planning::PlanRequest request = RequestFor(solid, state.range(1));
  std::int64_t subsets = 0;
  std::int64_t vertices = 0;
  for (auto _ : state) {
    const roadmap::Roadmap roadmap =
        roadmap::BuildRoadmap(request, roadmap::SpreadContacts(request));
    subsets = roadmap.candidate_count();
    vertices = roadmap.vertex_count();
  }
  Describe(state, subsets, vertices);
}

void BM_CountEdgesAndComponents(benchmark::State& state) {
  const planning::PlanRequest request = RequestFor(Model(state.range(0)), state.range(1));
  const roadmap::Roadmap roadmap = roadmap::BuildRoadmap(request, roadmap::SpreadContacts(request));
  for (auto _ : state) {
    benchmark::DoNotOptimize(roadmap.CountEdges());
    benchmark::DoNotOptimize(roadmap.FindComponents());
  }
  Describe(state, roadmap.candidate_count(), roadmap.vertex_count());
}

/// Measure a whole plan between two random grasps, including the roadmap, with another seed in each
/// iteration.
void BM_Plan(benchmark::State& state) {
  const object::Polyhedron& solid = Model(state.range(0));
  planning::PlanRequest request = RequestFor(solid, state.range(1));
  request.start = request.goal = {planning::GraspChoice::Kind::kRandomAny, {}, "random-any"};
  double switches = 0;
  for (auto _ : state) {
    const planning::PlanResult result = planning::Solve(roadmap::RoadmapPlanner(), request);
    ++request.seed;
    switches += result.plan ? static_cast<double>(result.plan->steps.size()) : 0;
  }
  state.SetLabel(kModels.at(state.range(0)));
  state.counters["switches"] = benchmark::Counter(switches, benchmark::Counter::kAvgIterations);
}

const std::vector<std::vector<std::int64_t>> kCases = {{0, 1}, {60, 70}};

BENCHMARK(BM_TestEverySubset)->ArgsProduct(kCases)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_BuildRoadmap)->ArgsProduct(kCases)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_CountEdgesAndComponents)->ArgsProduct(kCases)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Plan)->ArgsProduct({{0, 1}, {60}})->Unit(benchmark::kMillisecond);

}  // namespace
