#include "sim/actuation/hand_scene_export.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>

#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/mujoco/handles.h"
#include "planner/plan/projection.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "sim/scene/scaling.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"
#include "tests/sim/actuation/stock_scene.h"

namespace regrasp::sim {
namespace hand_scene_export_test {

/// Both kinds of fingertips are tested, because the model's own fingertips are spheres too.
class HandSceneExportTest : public FolderTest, public testing::WithParamInterface<TipShape> {};
INSTANTIATE_TEST_SUITE_P(Tips, HandSceneExportTest,
                         testing::Values(TipShape::kBall, TipShape::kGeometry),
                         [](const auto& tip) {
                           return tip.param == TipShape::kBall ? "Ball" : "Geometry";
                         });

TEST_P(HandSceneExportTest, StockMuJoCoLoadsItAndTheHandHoldsTheObjectAtEveryRest) {
  const std::string models = ProjectPath("models/");
  const kinematics::HandFile hand = kinematics::ReadHandFile(models + "hands/ring5.json");
  const object::ObjectFile cube = object::ReadObject(models + "cube.obj");
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*cube.object);
  gait::GaitRequest request;
  request.hand = &hand.hand;
  request.solid = &solid;
  request.scale = 0.8333;
  request.criteria.friction_angle = std::atan(0.5);
  request.criteria.min_quality = 0.06;
  request.turn = {Eigen::Vector3d::UnitZ(), 0.5};
  const gait::GaitResult found = gait::FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  plan::Plan plan = plan::ProjectPlan(solid, gait::PlanOf(*found.gait, request, found.contacts));
  plan.friction_angle = std::atan(0.8);

  std::vector<SceneKey> keys;
  HandReplayOptions options;
  options.mass_kg = 0.125;
  options.tip = GetParam();
  ReplayObserver observer;
  observer.on_rest = [&](const HandWorld& world, plan::EntryIndex entry) {
    keys.push_back({"rest " + std::to_string(entry), world.time(), world.Save().engine.qpos,
                    world.controls()});
  };
  const ReplayResult replay = ReplayHand(hand, solid, plan, options, observer);
  ASSERT_EQ(replay.steps.back().reason, plan::Reason::kNone) << replay.steps.back().detail;
  ASSERT_EQ(keys.size(), plan.steps.size() + 1);

  const std::vector<SceneFile> files =
      ExportHandScene(hand, solid, request.scale,
                      {.mu = 0.8, .mass_kg = *options.mass_kg, .tip = options.tip}, keys);
  EXPECT_EQ(files.back().name, kSceneName);
  for (const SceneFile& file : files) EXPECT_TRUE(IsSceneFile(file.name)) << file.name;
  const mujoco::ModelPtr model = LoadStockScene(files, folder_);
  const mujoco::DataPtr data(mj_makeData(model.get()));
  ASSERT_EQ(model->nkey, static_cast<int>(keys.size()));
  const int object = mj_name2id(model.get(), mjOBJ_BODY, "regrasp_object");
  ASSERT_GE(object, 0);
  EXPECT_NEAR(model->body_mass[object], *options.mass_kg, 1e-12);
  for (int key = 0; key < model->nkey; ++key) {
    mj_resetDataKeyframe(model.get(), data.get(), key);
    mj_forward(model.get(), data.get());
    EXPECT_EQ(keys[key].name, mj_id2name(model.get(), mjOBJ_KEY, key));
    EXPECT_NEAR(data->time, keys[key].time_s, 1e-9);
    EXPECT_EQ(data->ncon, static_cast<int>(replay.steps[key].snapshot.fingers.size()));
    const std::array<mjtNum, 3> before = {data->xpos[3 * object], data->xpos[3 * object + 1],
                                          data->xpos[3 * object + 2]};
    constexpr double kSeconds = 0.5;  // duration of a free fall of more than a metre
    while (data->time < keys[key].time_s + kSeconds) mj_step(model.get(), data.get());
    EXPECT_LT(mju_dist3(before.data(), data->xpos + 3 * object), 1e-3) << key;
  }
}

}  // namespace hand_scene_export_test
}  // namespace regrasp::sim
