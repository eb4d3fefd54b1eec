// Benchmark of the images of replays at 1280 × 960 with four samples per pixel: rendering of one
// image, and its PNG.
// The baseline is MuJoCo's renderer on the scene of the same replay, with the same size and number
// of samples, without labels and PNG. There is no baseline for images with a hand: compare them
// with images of the same object without a hand.

#include <GL/osmesa.h>
#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/gait/gait_planner.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/check.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "render/frames/frame.h"
#include "render/picture/image.h"
#include "report/pictures/hand_picture.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

constexpr double kFrictionAngleDegrees = 20;
constexpr int kWidth = 1280, kHeight = 960, kSamples = 4;

constexpr std::array<const char*, 7> kModels = {"cube.obj",     "l_block.obj",   "mug1000.obj",
                                                "duck1000.obj", "flask1000.obj", "spanner1000.obj",
                                                "wrench256.wkt"};

struct Case {
  object::ObjectFile file;
  plan::Plan plan;  ///< plan located on the surface
  std::vector<plan::Snapshot> snapshots;
  render::FrameOptions options = {.width = kWidth, .height = kHeight};
};

render::FrameRenderer RendererOf(const Case& made) {
  return {*made.file.object, made.plan.scale, made.plan.friction_angle, made.snapshots,
          made.options};
}

void DrawFrames(benchmark::State& state, const Case& made, const char* label) {
  render::FrameRenderer renderer = RendererOf(made);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        render::EncodePng(renderer.Render(made.snapshots.back(), {"step 1/1 · switch"})));
  }
  state.SetLabel(label);
}

/// The view is chosen once per plan.
void ChooseViews(benchmark::State& state, const Case& made, const char* label) {
  for (auto _ : state) benchmark::DoNotOptimize(RendererOf(made));
  state.SetLabel(label);
}

Case MakeCase(const std::string& model) {
  Case made{object::ReadObject(std::filesystem::path(REGRASP_MODELS) / model), {}, {}};
  const object::Object& object = *made.file.object;
  const planning::GraspChoice random = {planning::GraspChoice::Kind::kRandomAny, {}, "random"};
  const planning::PlanResult result =
      planning::Solve(*registry::FindPlanner("general"),
                      {.object = &object,
                       .start = random,
                       .goal = random,
                       .criteria = {.friction_angle = Radians(kFrictionAngleDegrees)},
                       .seed = 1});
  if (!result.plan) throw std::runtime_error(model + ": no plan to draw");
  made.plan = plan::CheckPlan(object, *result.plan).projected;
  for (const sim::StepReplay& step : sim::ReplayPlan(object, made.plan, {}).steps) {
    made.snapshots.push_back(step.snapshot);
  }
  return made;
}

const Case& GetCase(std::int64_t index) {
  static std::array<std::unique_ptr<Case>, kModels.size()> cases;
  if (!cases.at(index)) cases[index] = std::make_unique<Case>(MakeCase(kModels[index]));
  return *cases[index];
}

void BM_Frame(benchmark::State& state) {
  DrawFrames(state, GetCase(state.range(0)), kModels.at(state.range(0)));
}

void BM_Setup(benchmark::State& state) {
  ChooseViews(state, GetCase(state.range(0)), kModels.at(state.range(0)));
}

void BM_EncodePng(benchmark::State& state) {
  const Case& made = GetCase(state.range(0));
  render::FrameRenderer renderer = RendererOf(made);
  const render::Image image = renderer.Render(made.snapshots.back(), {"step 1/1 · switch"});
  for (auto _ : state) benchmark::DoNotOptimize(render::EncodePng(image));
  state.SetLabel(kModels.at(state.range(0)));
}

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

void BM_MuJoCoRender(benchmark::State& state) {
  const Case& made = GetCase(state.range(0));
  const std::string path = std::filesystem::temp_directory_path() / "regrasp_frame_bench.xml";
  WriteFile(path, sim::SceneMjcf(*made.file.object, made.plan, {}), Durability::kCached);
  std::array<char, 1000> message = {};
  const std::unique_ptr<mjModel, DeleteModel> model(
      mj_loadXML(path.c_str(), nullptr, message.data(), message.size()));
  std::filesystem::remove(path);
  if (!model) throw std::runtime_error(message.data());
  model->vis.global.offwidth = kWidth;
  model->vis.global.offheight = kHeight;
  model->vis.quality.offsamples = kSamples;
  const std::unique_ptr<mjData, DeleteData> data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  std::vector<unsigned char> window(4);
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 8, nullptr);
  OSMesaMakeCurrent(context, window.data(), GL_UNSIGNED_BYTE, 1, 1);
  mjvScene scene;
  mjv_defaultScene(&scene);
  constexpr int kMostGeoms = 2000;
  mjv_makeScene(model.get(), &scene, kMostGeoms);
  mjrContext renderer;
  mjr_defaultContext(&renderer);
  mjr_makeContext(model.get(), &renderer, mjFONTSCALE_50);
  mjr_setBuffer(mjFB_OFFSCREEN, &renderer);
  mjvCamera camera;
  mjv_defaultFreeCamera(model.get(), &camera);
  mjvOption options;
  mjv_defaultOption(&options);
  std::vector<unsigned char> pixels(std::size_t{3} * kWidth * kHeight);
  const mjrRect viewport = {0, 0, kWidth, kHeight};
  for (auto _ : state) {
    mjv_updateScene(model.get(), data.get(), &options, nullptr, &camera, mjCAT_ALL, &scene);
    mjr_render(viewport, &scene, &renderer);
    mjr_readPixels(pixels.data(), nullptr, viewport, &renderer);
  }
  state.SetLabel(kModels.at(state.range(0)));
  mjr_freeContext(&renderer);
  mjv_freeScene(&scene);
  OSMesaDestroyContext(context);
}

constexpr std::array<const char*, 2> kHands = {"ring4.json", "ring5.json"};

/// Return the case of a hand that rotates a cube by 90 degrees.
Case MakeHandCase(const std::string& name) {
  const std::filesystem::path models = REGRASP_MODELS;
  const kinematics::HandFile hand = kinematics::ReadHandFile((models / "hands" / name).string());
  Case made{object::ReadObject(models / "cube.obj"), {}, {}};
  const object::Object& object = *made.file.object;
  constexpr double kScale = 0.8;
  planning::PlanRequest request;
  request.object = &object;
  request.criteria.friction_angle = std::atan(0.8);
  gait::AskInHand(
      {.hand = &hand.hand, .scale = kScale, .turn = {Eigen::Vector3d::UnitZ(), Radians(90)}},
      request);
  const planning::PlanResult result = planning::Solve(gait::GaitPlanner(), request);
  if (!result.plan) throw std::runtime_error(name + ": no plan to draw");
  made.plan = plan::ProjectPlan(object, *result.plan);
  const report::HandPicture picture(hand, made.plan, kScale * object.mass_properties().centroid);
  for (const sim::StepReplay& step : sim::ReplayPlan(object, made.plan, {}).steps) {
    made.snapshots.push_back(step.snapshot);
    plan::Fault none;
    picture.Place(step.index, made.snapshots.back(), none);
  }
  made.options.hand = picture.view();
  return made;
}

const Case& GetHandCase(std::int64_t index) {
  static std::array<std::unique_ptr<Case>, kHands.size()> cases;
  if (!cases.at(index)) cases[index] = std::make_unique<Case>(MakeHandCase(kHands[index]));
  return *cases[index];
}

void BM_HandFrame(benchmark::State& state) {
  DrawFrames(state, GetHandCase(state.range(0)), kHands.at(state.range(0)));
}

void BM_HandSetup(benchmark::State& state) {
  ChooseViews(state, GetHandCase(state.range(0)), kHands.at(state.range(0)));
}

constexpr int kLast = static_cast<int>(kModels.size()) - 1;
BENCHMARK(BM_Frame)->DenseRange(0, kLast)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MuJoCoRender)->DenseRange(0, kLast)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_EncodePng)->DenseRange(0, kLast)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Setup)->DenseRange(0, kLast)->Unit(benchmark::kMillisecond);
constexpr int kLastHand = static_cast<int>(kHands.size()) - 1;
BENCHMARK(BM_HandFrame)->DenseRange(0, kLastHand)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_HandSetup)->DenseRange(0, kLastHand)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
