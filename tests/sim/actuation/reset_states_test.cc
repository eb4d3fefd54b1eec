#include "sim/actuation/reset_states.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/gait/random_stances.h"
#include "planner/mujoco/handles.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/scene/scaling.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"
#include "tests/sim/actuation/stock_scene.h"

namespace regrasp::sim {
namespace reset_states_test {

constexpr int kMostSimulated = 40;

class ResetStatesTest : public FolderTest {
 protected:
  ResetStatesTest() {
    request_.hand = &hand_.hand;
    request_.solid = &solid();
    request_.scale = 0.8333;
    options_.friction_angle = std::atan(0.8);
    options_.mass_kg = 0.125;
    request_.criteria.friction_angle = options_.friction_angle;
  }
  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*cube_.object);
  }
  [[nodiscard]] DrawRest MakeDraw(int tries) const {
    const gait::RandomStanceOptions options{.fewest = 3, .most = 5};
    const auto rests = std::make_shared<gait::RandomStances>(request_, options);
    return [rests, tries](RandomStream& random) -> std::optional<RestToHold> {
      auto rest = rests->Draw(random, tries);
      if (!rest) return std::nullopt;
      return RestToHold{rest->state, rest->grasp};
    };
  }
  [[nodiscard]] DrawnStates Draw(int count, std::uint64_t seed, int jobs) const {
    return DrawResetStates(
        hand_, solid(), request_.scale, options_,
        {.count = count, .seed = seed, .most_simulated = kMostSimulated, .jobs = jobs},
        [this] { return MakeDraw(20'000); });
  }
  [[nodiscard]] std::string Bytes(const DrawnStates& drawn) const {
    return FormatResetStates(drawn, hand_.hand, options_, {"cube.obj", cube_.sha256, 1, 0});
  }

  const std::string models_ = ProjectPath("models/");
  kinematics::HandFile hand_ = kinematics::ReadHandFile(models_ + "hands/ring5.json");
  object::ObjectFile cube_ = object::ReadObject(models_ + "cube.obj");
  gait::GaitRequest request_;
  ResetStateOptions options_;
};

TEST_F(ResetStatesTest, AStateDependsOnTheSeedAndItsNumberAlone) {
  const DrawnStates one = Draw(6, 7, 1);
  ASSERT_EQ(one.states.size(), 6U) << one.message;
  EXPECT_EQ(Bytes(one), Bytes(Draw(6, 7, 2)));
  EXPECT_NE(Bytes(one), Bytes(Draw(6, 8, 1)));
  const DrawnStates few = Draw(4, 7, 2);
  for (std::size_t i = 0; i < few.states.size(); ++i) {
    EXPECT_EQ(few.states[i].qpos, one.states[i].qpos) << i;
    EXPECT_EQ(few.states[i].controls, one.states[i].controls) << i;
    EXPECT_EQ(few.states[i].off_m, one.states[i].off_m) << i;
  }
}

TEST_F(ResetStatesTest, StatesAreHeldAgainFromWhatIsStored) {
  DrawnStates drawn = Draw(8, 3, 2);
  ASSERT_EQ(drawn.states.size(), 8U) << drawn.message;
  ResetStates states(hand_, solid(), request_.scale, options_);
  for (ResetState state : drawn.states) {
    EXPECT_GE(std::ranges::count_if(state.tips, &ResetState::Tip::holds), 3);
    const double off = state.off_m;
    EXPECT_FALSE(states.Validate(state));
    EXPECT_EQ(state.off_m, off);
    EXPECT_LE(off, options_.tolerance.at_rest * options_.tolerance.length_m);
  }
}

TEST_F(ResetStatesTest, TheForcesOfAStateCarryTheWeight) {
  const DrawnStates drawn = Draw(6, 4, 2);
  ASSERT_EQ(drawn.states.size(), 6U) << drawn.message;
  for (const ResetState& state : drawn.states) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const ResetState::Tip& tip : state.tips) sum += tip.force_O;
    const Eigen::Vector4d& q = state.quaternion;
    const Eigen::Vector3d up =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * hand_.hand.up;
    // Nearly static, because the object settles in a fraction of a second.
    EXPECT_LT((sum - kGravity * options_.mass_kg * up).norm(), 0.1 * kGravity * options_.mass_kg);
  }
}

TEST_F(ResetStatesTest, WithoutControlsOrFrictionTheObjectFalls) {
  const DrawnStates drawn = Draw(6, 5, 2);
  ASSERT_EQ(drawn.states.size(), 6U) << drawn.message;
  ResetStates states(hand_, solid(), request_.scale, options_);
  ResetStateOptions slippery = options_;
  slippery.friction_factor = 0.05;
  ResetStates slippery_states(hand_, solid(), request_.scale, slippery);
  for (const ResetState& state : drawn.states) {
    ResetState limp = state;
    std::ranges::fill(limp.controls, 0);
    EXPECT_TRUE(states.Validate(limp));
    ResetState sliding = state;
    EXPECT_TRUE(slippery_states.Validate(sliding));
  }
}

TEST_F(ResetStatesTest, WhatFallsIsCountedAndNotTaken) {
  options_.friction_factor = 0.6;  // share of the assumed friction; some states still hold
  const DrawnStates drawn = Draw(6, 1, 2);
  ASSERT_EQ(drawn.states.size(), 6U) << drawn.message;
  EXPECT_GT(drawn.fallen_count(), 0);
  EXPECT_GT(drawn.fallen_share(), 0);
  ResetStates states(hand_, solid(), request_.scale, options_);
  for (ResetState state : drawn.states) EXPECT_FALSE(states.Validate(state));
}

TEST_F(ResetStatesTest, WhatNoHandHoldsEndsWithTheReason) {
  options_.friction_factor = 0.01;
  const DrawnStates none = Draw(2, 1, 2);
  EXPECT_TRUE(none.states.empty());
  EXPECT_NE(none.message.find("none of "), std::string::npos) << none.message;
  EXPECT_NE(none.message.find("slipped"), std::string::npos) << none.message;
  request_.scale = 10;  // edge length of 0.5 m
  const DrawnStates large = Draw(2, 1, 2);
  EXPECT_TRUE(large.states.empty());
  EXPECT_EQ(large.message, "random grasps within reach of the hand are not force closure");
}

TEST_F(ResetStatesTest, StockMuJoCoHoldsThemInTheSceneThatIsExported) {
  const DrawnStates drawn = Draw(10, 2, 2);
  ASSERT_EQ(drawn.states.size(), 10U) << drawn.message;
  const mujoco::ModelPtr model = LoadStockScene(
      ExportHandScene(hand_, solid(), request_.scale, {0.8, options_.mass_kg, kGravity}, {}),
      folder_);
  const mujoco::DataPtr data(mj_makeData(model.get()));
  const int object = mj_name2id(model.get(), mjOBJ_BODY, "regrasp_object");
  for (const ResetState& state : drawn.states) {
    mj_resetData(model.get(), data.get());
    ASSERT_EQ(std::ssize(state.qpos), model->nq);
    ASSERT_EQ(std::ssize(state.controls), model->nu);
    std::ranges::copy(state.qpos, data->qpos);
    std::ranges::copy(state.controls, data->ctrl);
    mj_forward(model.get(), data.get());
    EXPECT_EQ(data->ncon, std::ranges::count_if(state.tips, &ResetState::Tip::holds));
    const std::array<mjtNum, 3> before = {data->xpos[3 * object], data->xpos[3 * object + 1],
                                          data->xpos[3 * object + 2]};
    while (data->time < 1) mj_step(model.get(), data.get());
    EXPECT_LT(mju_dist3(before.data(), data->xpos + 3 * object), 1e-3);
  }
}

}  // namespace reset_states_test
}  // namespace regrasp::sim
