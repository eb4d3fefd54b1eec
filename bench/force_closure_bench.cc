// Benchmark of force closure for random grasps of four contacts. Exact cones are compared with the
// two usual methods on the same grasps in the same run: a pyramid with eight sides in a linear
// program (GLPK), and the hull of the wrenches (Qhull).
// It prints the agreement of the verdicts and the ratios of the times, also for grasps of three
// contacts in the plane.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "bench/pyramid_force_closure.h"
#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/subset_force_closure.h"

namespace {

using namespace regrasp;

constexpr int kContacts = 4;
constexpr int kGrasps = 2000;
constexpr int kHullGrasps = 100;  // Qhull takes milliseconds per grasp
constexpr std::array kDegrees{10.0, 20.0};
const object::WrenchFrame kFrame{Eigen::Vector3d::Zero(), 1, 3};
const object::WrenchFrame kPlane{Eigen::Vector3d::Zero(), 1, 2};
constexpr int kPlanarContacts = 3;

/// Return a random contact: half of the points on a sphere with normals up to 17° off, half on a
/// box.
grasp::Contact RandomContact(std::mt19937_64& engine, bool box) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
  };
  if (!box) {
    const Eigen::Vector3d p = direction();
    return {p, (-p + 0.3 * direction()).normalized()};
  }
  std::uniform_real_distribution<double> uniform(-1, 1);
  grasp::Contact contact{{uniform(engine), uniform(engine), uniform(engine)}, {0, 0, 0}};
  const int axis = std::uniform_int_distribution<int>(0, 2)(engine);
  const double side = uniform(engine) < 0 ? -1 : 1;
  contact.p[axis] = side;
  contact.n[axis] = -side;
  return contact;
}

const std::vector<grasp::Grasp>& Grasps() {
  static const std::vector<grasp::Grasp> grasps = [] {
    std::mt19937_64 engine(2026);
    std::vector<grasp::Grasp> result(kGrasps);
    for (int g = 0; g < kGrasps; ++g) {
      for (int i = 0; i < kContacts; ++i) result[g].push_back(RandomContact(engine, g % 2 == 0));
    }
    return result;
  }();
  return grasps;
}

/// Return grasps on a circle, with normals up to 17° off.
const std::vector<grasp::Grasp>& PlanarGrasps() {
  static const std::vector<grasp::Grasp> grasps = [] {
    std::mt19937_64 engine(2026);
    std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
    std::uniform_real_distribution<double> lean(-0.3, 0.3);
    std::vector<grasp::Grasp> result(kGrasps);
    for (grasp::Grasp& grasp : result) {
      for (int i = 0; i < kPlanarContacts; ++i) {
        const double at = turn(engine);
        const double inward = at + std::numbers::pi + lean(engine);
        grasp.push_back({{std::cos(at), std::sin(at), 0}, {std::cos(inward), std::sin(inward), 0}});
      }
    }
    return result;
  }();
  return grasps;
}

bool GlpkForceClosure(const grasp::Grasp& grasp, double friction_angle) {
  return PyramidForceClosure(grasp, friction_angle);
}

bool QhullForceClosure(const grasp::Grasp& grasp, double friction_angle) {
  const grasp::ConvexHull hull =
      grasp::ComputeConvexHull(WrenchesOfPyramids(grasp, friction_angle));
  for (const grasp::HullFacet& facet : hull.facets) {
    if (facet.offset <= hull.joggle) return false;
  }
  return true;
}

bool ExactForceClosure(const grasp::Grasp& grasp, double friction_angle) {
  return grasp::IsForceClosure(grasp, kFrame, friction_angle);
}

template <bool (*kTest)(const grasp::Grasp&, double), int kCount>
void Time(benchmark::State& state) {
  const double friction_angle = Radians(kDegrees[state.range(0)]);
  const auto& grasps = Grasps();
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kTest(grasps[next], friction_angle));
    next = (next + 1) % kCount;
  }
  state.counters["degrees"] = kDegrees[state.range(0)];
}

void TimePlanar(benchmark::State& state) {
  const double friction_angle = Radians(kDegrees[state.range(0)]);
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(grasp::IsForceClosure(PlanarGrasps()[next], kPlane, friction_angle));
    next = (next + 1) % kGrasps;
  }
  state.counters["degrees"] = kDegrees[state.range(0)];
}

void TimeRequired(benchmark::State& state) {
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(grasp::ComputeRequiredFrictionAngle(Grasps()[next], kFrame));
    next = (next + 1) % kGrasps;
  }
}

/// Test all subsets of 4 of `range(0)` points on a sphere.
void TimeSubsets(benchmark::State& state) {
  std::mt19937_64 engine(7);
  grasp::Grasp points;
  for (int i = 0; i < state.range(0); ++i) points.push_back(RandomContact(engine, false));
  grasp::SubsetCounts counts;
  for (auto _ : state) {
    benchmark::DoNotOptimize(grasp::ForceClosureSubsets(points, kFrame, Radians(10), &counts));
  }
  state.counters["subsets"] = static_cast<double>(counts.subsets);
  state.counters["by_simplex"] = static_cast<double>(counts.by_simplex);
}

BENCHMARK(Time<ExactForceClosure, kGrasps>)->Name("exact cones")->DenseRange(0, 1);
BENCHMARK(Time<GlpkForceClosure, kGrasps>)->Name("GLPK, 8 sides")->DenseRange(0, 1);
BENCHMARK(Time<QhullForceClosure, kHullGrasps>)
    ->Name("Qhull, 8 sides")
    ->DenseRange(0, 1)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(TimePlanar)->Name("exact cones in the plane")->DenseRange(0, 1);
BENCHMARK(TimeRequired)->Name("required friction angle")->Unit(benchmark::kMicrosecond);
BENCHMARK(TimeSubsets)->Name("all 4-subsets")->Arg(60)->Arg(70)->Unit(benchmark::kMillisecond);

template <typename Test>
double MicrosecondsEach(int count, Test test) {
  const auto start = std::chrono::steady_clock::now();
  for (int g = 0; g < count; ++g) benchmark::DoNotOptimize(test(Grasps()[g]));
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
  return time.count() / count;
}

/// An inscribed pyramid with eight sides misses grasps, but must not accept a grasp that the cone
/// rejects.
void CompareVerdicts(double degrees) {
  const double friction_angle = Radians(degrees);
  int both = 0;
  int neither = 0;
  int only_cone = 0;
  int only_pyramid = 0;
  for (const grasp::Grasp& grasp : Grasps()) {
    const bool cone = ExactForceClosure(grasp, friction_angle);
    const bool pyramid = GlpkForceClosure(grasp, friction_angle);
    ++(cone ? (pyramid ? both : only_cone) : (pyramid ? only_pyramid : neither));
  }
  int hull_differs = 0;
  for (int g = 0; g < kHullGrasps; ++g) {
    hull_differs += QhullForceClosure(Grasps()[g], friction_angle) !=
                    GlpkForceClosure(Grasps()[g], friction_angle);
  }
  std::printf(
      "%g degrees, %d grasps: both yes %d, both no %d, cone only %d (the inscribed pyramid is "
      "smaller), pyramid only %d (must be 0); Qhull differs from GLPK on %d of %d\n",
      degrees, kGrasps, both, neither, only_cone, only_pyramid, hull_differs, kHullGrasps);
  const double exact = MicrosecondsEach(
      kGrasps, [&](const grasp::Grasp& g) { return ExactForceClosure(g, friction_angle); });
  const double glpk = MicrosecondsEach(
      kGrasps, [&](const grasp::Grasp& g) { return GlpkForceClosure(g, friction_angle); });
  const double qhull = MicrosecondsEach(
      kHullGrasps, [&](const grasp::Grasp& g) { return QhullForceClosure(g, friction_angle); });
  std::printf("  exact cones %.3f us; GLPK %.1f us, %.0f times; Qhull %.0f us, %.0f times\n", exact,
              glpk, glpk / exact, qhull, qhull / exact);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const double degrees : kDegrees) CompareVerdicts(degrees);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
