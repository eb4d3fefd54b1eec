#include "sim/scene/scene.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <limits>
#include <set>

#include "planner/base/error.h"
#include "sim/scene/mujoco_engine.h"
#include "sim/scene/scaling.h"
#include "tests/sim/mujoco_file.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace scene_test {

TEST(SceneMjcfTest, StockMujocoLoadsItAndItsKeyframeHoldsTheObject) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  const auto model = LoadFromFile(SceneMjcf(cube.object, plan, {}));
  ASSERT_NE(model, nullptr);
  ASSERT_EQ(model->nkey, 1);
  const DataPtr data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) mj_step(model.get(), data.get());
  const double moved = mju_norm3(data->qpos);
  EXPECT_LT(moved, 1e-3 * cube.object.diameter());
  // Without the controls the object falls.
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mju_zero(data->ctrl, model->nu);
  for (int i = 0; i < kSteps; ++i) mj_step(model.get(), data.get());
  EXPECT_GT(mju_norm3(data->qpos), 1e-2 * cube.object.diameter());
}

TEST(SceneTest, TheInertiaIsThatOfABodyOfItsScale) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  for (const double scale : {0.1, 1.0, 3.0}) {
    plan.scale = scale;
    const Scene scene = MakeScene(cube.object, plan, 0, {});
    const double edge = 0.06 * scale;  // moments of a cube: m a² / 6
    const double moment = scene.settings.mass_kg * edge * edge / 6;
    EXPECT_LT((scene.inertia - moment * Eigen::Matrix3d::Identity()).norm(), 1e-9 * moment);
  }
}

TEST(SceneMjcfTest, CarriesTheMassOfTheSolidAndAllDigits) {
  const object::ObjectFile file = ReadModel("l_block.obj");
  const object::Object& l = *file.object;
  plan::Plan plan = MakePlan({{FingerIndex(0), ContactAt(l, {0.07, 0.04, 0.002}, {0, -1, 0})},
                              {FingerIndex(1), ContactAt(l, {0.068, 0, -0.001}, {0, 1, 0})},
                              {FingerIndex(2), ContactAt(l, {0.04, 0.07, -0.002}, {-1, 0, 0})},
                              {FingerIndex(3), ContactAt(l, {0, 0.069, 0.003}, {1, 0, 0})}},
                             30);
  const auto model = LoadFromFile(SceneMjcf(l, plan, {}));
  ASSERT_NE(model, nullptr);
  const int body = mj_name2id(model.get(), mjOBJ_BODY, "object");
  const object::MassProperties& mass = l.mass_properties();
  EXPECT_EQ(model->body_mass[body], 1000 * mass.volume);
  const double trace = model->body_inertia[3 * body] + model->body_inertia[3 * body + 1] +
                       model->body_inertia[3 * body + 2];
  EXPECT_NEAR(trace, 1000 * mass.inertia.trace(), 1e-9 * trace);
  const ReplaySettings settings = ReplayPlan(l, plan, {}).settings;
  EXPECT_EQ(model->opt.timestep, settings.timestep_s);
  const int finger = mj_name2id(model.get(), mjOBJ_GEOM, "finger0");
  EXPECT_EQ(model->geom_friction[3 * finger], settings.mu);
  EXPECT_EQ(model->geom_size[3 * finger], settings.fingertip_radius_m);
}

TEST(SceneTest, OnlyFingersThatTouchAreCounted) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.fingers = 64;
  const auto fingers_that_touch = [&] {
    const Scene scene = MakeScene(cube.object, plan, static_cast<int>(plan.steps.size()), {});
    EXPECT_EQ(scene.fingers.size(), 64u);
    std::set<int> bits;
    for (const SceneFinger& finger : scene.fingers) bits.insert(finger.collision_bit);
    bits.erase(0);
    return bits.size();
  };
  EXPECT_EQ(fingers_that_touch(), plan.initial.size());
  // One finger after the other takes over the same contact.
  FingerIndex last = plan.initial.front().finger;
  for (FingerIndex finger{33}; finger < 33 + 31 - static_cast<int>(plan.initial.size()); ++finger) {
    plan.steps.push_back(plan::Switch{{{finger, plan.initial.front().contact}}, {last}});
    last = finger;
  }
  EXPECT_EQ(fingers_that_touch(), 31u);
  plan.steps.push_back(plan::Switch{{{FingerIndex(32), plan.initial.front().contact}}, {last}});
  EXPECT_THROW((void)fingers_that_touch(), InputError);
}

TEST(SceneMjcfTest, SaysTheSameTwice) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  EXPECT_EQ(SceneMjcf(cube.object, plan, {}), SceneMjcf(cube.object, plan, {}));
}

Scene CubeScene(const CubeCase& cube) {
  return MakeScene(dynamic_cast<const object::Polyhedron&>(cube.object), MakePlan(cube.Start(), 25),
                   0, {});
}

/// Return the MJCF without comments.
std::string WithoutComments(std::string mjcf) {
  for (std::size_t begin; (begin = mjcf.find("<!--")) != std::string::npos;) {
    mjcf.erase(begin, mjcf.find("-->", begin) + 3 - begin);
  }
  return mjcf;
}

TEST(SceneMjcfTest, LeavesOutWhatLaterVersionsOfMujocoRenamed) {
  const CubeCase cube;
  const std::string mjcf = SceneMjcf(cube.object, MakePlan(cube.Start(), 25), {});
  const std::string read = WithoutComments(mjcf);
  for (const char* renamed : {"mpr_", "ccd_", "njmax", "nconmax", "directional"}) {
    EXPECT_EQ(read.find(renamed), std::string::npos) << renamed;
  }
  // A comment states how to set the collision tolerance of the replay.
  EXPECT_NE(mjcf.find("mpr_iterations=\"500\""), std::string::npos);
  EXPECT_EQ(mjcf.find("brace"), std::string::npos);
  // The replay itself sets it.
  EXPECT_NE(WithoutComments(FormatScene(CubeScene(cube), cube.object, {}, false)).find("mpr_"),
            std::string::npos);
}

TEST(EngineTest, AnErrorOfTheEngineBecomesAnException) {
  const CubeCase cube;
  const MujocoEngine engine(
      FormatScene(CubeScene(cube), dynamic_cast<const object::Polyhedron&>(cube.object), {}, false),
      5);
  EXPECT_THROW(mju_error("made up"), UnstableError);
  mju_warning("this reaches neither the terminal nor a file");
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(EngineTest, AStateThatIsNotFiniteIsUnstable) {
  const CubeCase cube;
  MujocoEngine engine(
      FormatScene(CubeScene(cube), dynamic_cast<const object::Polyhedron&>(cube.object), {}, false),
      5);
  engine.Step();
  engine.SetLoad({std::numeric_limits<double>::quiet_NaN(), 0, 0}, Eigen::Vector3d::Zero());
  EXPECT_THROW(engine.Step(), UnstableError);
}

TEST(EngineTest, AnAccelerationBeyondTheEnginesLimitIsUnstable) {
  const CubeCase cube;
  MujocoEngine engine(
      FormatScene(CubeScene(cube), dynamic_cast<const object::Polyhedron&>(cube.object), {}, false),
      5);
  engine.SetLoad({1e30, 0, 0}, Eigen::Vector3d::Zero());
  EXPECT_THROW(engine.Step(), UnstableError);
}

TEST(EngineTest, ASceneThatIsNoSceneIsRefused) {
  EXPECT_THROW(MujocoEngine("<mujoco><worldbody><geom/></worldbody></mujoco>", 0),
               EnvironmentError);
}

TEST(EngineTest, StepsFromASavedStateRepeatTheSameBits) {
  const CubeCase cube;
  MujocoEngine engine(
      FormatScene(CubeScene(cube), dynamic_cast<const object::Polyhedron&>(cube.object), {}, false),
      5);
  engine.SetGravity(kGravity);
  for (int i = 0; i < 10; ++i) engine.Step();
  const Engine::State state = engine.Save();
  const auto run = [&] {
    for (int i = 0; i < 50; ++i) engine.Step();
    return engine.Save().qpos;
  };
  const std::vector<double> first = run();
  engine.Restore(state);
  EXPECT_EQ(first, run());
  EXPECT_NE(first, state.qpos);
}

TEST(Scaling, KeepsTheRatiosThatMakeEveryBodyTheSameExperiment) {
  const CubeCase cube;
  int checked = 0;
  for (const double scale : {0.1, 1.0, 10.0}) {
    for (const double density : {10.0, 1000.0, 8000.0}) {
      ReplayOptions options;
      options.density_kg_m3 = density;
      const ReplaySettings s = DeriveSettings(cube.object, scale, 0.4, 1e9, options);
      EXPECT_GE(s.finger_stiffness_N_m * s.diameter_m / s.grasp_force_N, 5);
      EXPECT_LE(s.finger_damping_Ns_m * s.timestep_s / s.finger_mass_kg, 0.6);
      EXPECT_NEAR(s.finger_damping_Ns_m, 2 * std::sqrt(s.finger_stiffness_N_m * s.finger_mass_kg),
                  1e-9 * s.finger_damping_Ns_m);
      EXPECT_NEAR(s.mass_kg * kGravity / (s.disturbance_ratio * s.grasp_force_N),
                  kWeightOfDisturbance, 1e-12);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 9);
}

}  // namespace scene_test
}  // namespace regrasp::sim
