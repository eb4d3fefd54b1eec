// Benchmark of the replay of whole plans.
// It measures steps of the report (including the initial grasp) per second, and the share of the
// time inside mj_step. The baseline is the same number of bare steps of the exported scene in
// static equilibrium.

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "sim/replay/replay.h"
#include "sim/scene/scene.h"
#include "sim/world/replay_world.h"

namespace {

using Clock = std::chrono::steady_clock;

/// Engine time and number of calls since the last reset.
struct EngineTime {
  std::int64_t steps = 0;
  Clock::duration inside{};
};
EngineTime engine_time;

}  // namespace

// The linker redirects every call of mj_step here (--wrap), so that the shipped code is measured.
extern "C" {
void __real_mj_step(const mjModel* model, mjData* data);
void __wrap_mj_step(const mjModel* model, mjData* data) {
  const auto start = Clock::now();
  __real_mj_step(model, data);
  engine_time.inside += Clock::now() - start;
  ++engine_time.steps;
}
}

namespace {

using namespace regrasp;

constexpr double kFrictionAngleDegrees = 20;

/// A block whose contact patches are boxes, objects with mesh patches, convex and not, and a
/// polygon.
constexpr std::array<const char*, 4> kModels = {"cube.obj", "stone.obj", "l_block.obj",
                                                "polygon15.wkt"};

struct Case {
  object::ObjectFile file;
  plan::Plan plan;  ///< plan located on the surface
};

Case MakeCase(const std::string& model) {
  Case made{object::ReadObject(std::filesystem::path(REGRASP_MODELS) / model), {}};
  const object::Object& object = *made.file.object;
  const planning::GraspChoice random = {planning::GraspChoice::Kind::kRandom, {}, "random"};
  const bool planar = object.dimension() == 2;
  const planning::PlanResult result =
      planning::Solve(*registry::FindPlanner(planar ? "polygon" : "roadmap"),
                      {.object = &object,
                       .start = random,
                       .goal = random,
                       .criteria = {.friction_angle = Radians(kFrictionAngleDegrees)},
                       // for the plane, a seed whose plan has three switches
                       .seed = planar ? 2ULL : 0ULL});
  if (!result.plan) throw std::runtime_error(model + ": no plan to replay");
  made.plan = plan::CheckPlan(object, *result.plan).projected;
  return made;
}

const Case& GetCase(std::int64_t index) {
  static std::array<std::unique_ptr<Case>, kModels.size()> cases;
  if (!cases.at(index)) cases[index] = std::make_unique<Case>(MakeCase(kModels[index]));
  return *cases[index];
}

double Seconds(Clock::duration time) { return std::chrono::duration<double>(time).count(); }

void BM_Replay(benchmark::State& state) {
  const Case& made = GetCase(state.range(0));
  const auto entries = static_cast<double>(made.plan.steps.size() + 1);
  engine_time = {};
  const auto start = Clock::now();
  for (auto _ : state) {
    const sim::ReplayResult result = sim::ReplayPlan(*made.file.object, made.plan, {});
    if (result.steps.back().reason != plan::Reason::kNone) {
      state.SkipWithError("the plan failed");
      return;
    }
  }
  const double all = Seconds(Clock::now() - start);
  state.SetLabel(kModels.at(state.range(0)));
  state.counters["entries"] = entries;
  state.counters["entries_per_s"] =
      benchmark::Counter(entries, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["mj_steps"] =
      static_cast<double>(engine_time.steps) / static_cast<double>(state.iterations());
  state.counters["inside_mj_step"] = Seconds(engine_time.inside) / all;
}

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// Run only as many steps as the replay of the plan.
void BM_BareSteps(benchmark::State& state) {
  const Case& made = GetCase(state.range(0));
  engine_time = {};
  (void)sim::ReplayPlan(*made.file.object, made.plan, {});
  const std::int64_t steps = engine_time.steps;
  const std::string mjcf = sim::SceneMjcf(*made.file.object, made.plan, {});
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  mj_makeEmptyFileVFS(vfs.get(), "scene.xml", static_cast<int>(mjcf.size()));
  mjcf.copy(static_cast<char*>(vfs->filedata[mj_findFileVFS(vfs.get(), "scene.xml")]), mjcf.size());
  std::array<char, 1000> error{};
  const std::unique_ptr<mjModel, DeleteModel> model(
      mj_loadXML("scene.xml", vfs.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(vfs.get());
  if (!model) throw std::runtime_error(error.data());
  const std::unique_ptr<mjData, DeleteData> data(mj_makeData(model.get()));
  mju_user_warning = [](const char*) {};  // prevents a log file
  for (auto _ : state) {
    mj_resetDataKeyframe(model.get(), data.get(), 0);
    for (std::int64_t i = 0; i < steps; ++i) __real_mj_step(model.get(), data.get());
  }
  state.SetLabel(kModels.at(state.range(0)));
  state.counters["mj_steps"] = static_cast<double>(steps);
}

/// Measure the setup before the first step: the scene, its compilation and its first state.
void BM_Setup(benchmark::State& state) {
  const Case& made = GetCase(state.range(0));
  const object::Object& object = *made.file.object;
  const sim::ReplayObserver observer;
  for (auto _ : state) {
    const sim::ReplayWorld stage(
        object, made.plan,
        sim::MakeScene(object, made.plan, static_cast<int>(made.plan.steps.size()), {}), observer);
    benchmark::DoNotOptimize(stage.engine().time());
  }
  state.SetLabel(kModels.at(state.range(0)));
}

BENCHMARK(BM_Setup)->DenseRange(0, kModels.size() - 1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Replay)->DenseRange(0, kModels.size() - 1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_BareSteps)->DenseRange(0, kModels.size() - 1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
