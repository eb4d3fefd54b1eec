#include "sim/actuation/joint_couplings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/mujoco/handles.h"
#include "sim/actuation/execution_monitor.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_world.h"
#include "sim/scene/scaling.h"
#include "tests/sim/actuation/edited_hand.h"
#include "tests/sim/actuation/model_fields.h"
#include "tests/sim/actuation/stock_scene.h"

namespace regrasp::sim {
namespace joint_couplings_test {

using plan::Reason;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class JointCouplingsTest : public EditedHandTest {
 protected:
  [[nodiscard]] HandReplayOptions Options() const {
    HandReplayOptions options;
    options.mass_kg = kMass;
    return options;
  }
};

/// Return the fields of a model that change if MuJoCo computes them again.
std::vector<std::string> StaleFields(const mjModel& model) {
  const mujoco::ModelPtr fresh(mj_copyModel(nullptr, &model));
  const mujoco::DataPtr data(mj_makeData(fresh.get()));
  mj_setConst(fresh.get(), data.get());
  return DifferentFields(model, *fresh, 0);
}

TEST_F(JointCouplingsTest, NoConstantOfTheReplaysModelIsStale) {
  for (const kinematics::HandFile& hand : {HandWith({}), CoupledHand(), HandOnWrist()}) {
    const HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
    EXPECT_THAT(StaleFields(world.model()), IsEmpty());
    // Negative control: a change without recomputation is detected.
    const mujoco::ModelPtr changed(mj_copyModel(nullptr, &world.model()));
    changed->dof_armature[0] += 1;
    const std::vector<std::string> stale = StaleFields(*changed);
    EXPECT_THAT(stale, Contains("dof_invweight0"));
    EXPECT_THAT(stale, Contains("dof_M0"));
    EXPECT_THAT(stale, Contains("body_invweight0"));
  }
}

TEST_F(JointCouplingsTest, CoupledJointsStayCoupledWhateverTheServosAre) {
  const kinematics::HandFile hand = CoupledHand();
  const plan::Plan plan = PlanFor(hand);
  double largest = 0;
  ReplayObserver observer;
  observer.on_time_step = [&](const HandWorld& world) {
    for (const std::vector<double>& q : world.state().joints) {
      largest = std::max(largest, std::abs(q[3] - q[2]));
    }
  };
  const ReplayResult result = ReplayHand(hand, solid(), plan, Options(), observer);
  EXPECT_EQ(result.steps.back().reason, Reason::kNone) << result.steps.back().detail;
  EXPECT_TRUE(result.settings.hand->derived_servos);
  EXPECT_GT(largest, 0);
  EXPECT_LT(Degrees(largest), 0.5);
  double measured = 0;
  for (const StepReplay& step : result.steps) {
    measured = std::max(measured, step.hand->coupling_rad);
  }
  EXPECT_GE(measured, largest - 1e-12);
  EXPECT_LT(Degrees(measured), 0.5);
}

TEST_F(JointCouplingsTest, AJointThatIsOffItsCouplingIsNamed) {
  const kinematics::HandFile hand = CoupledHand();
  const plan::Plan plan = PlanFor(hand);
  HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  for (const double degrees : {0.9, 1.1}) {
    plan::HandState state = plan.hand->initial;
    state.pose.translation().z() += 1;  // out of reach
    state.joints[1][3] += Radians(degrees);
    world.Place(state);
    ExecutionMonitor monitor(world, solid(), kScale, {});
    monitor.Start();
    monitor.Watch(state.pose);
    EXPECT_NEAR(Degrees(monitor.measures().coupling_rad), degrees, 1e-6);
    ASSERT_EQ(monitor.violation().has_value(), degrees > 1);
    if (!monitor.violation()) continue;
    EXPECT_EQ(monitor.violation()->reason, Reason::kCouplingViolated);
    EXPECT_THAT(monitor.violation()->detail,
                HasSubstr("joint finger1_joint3, which is coupled to finger1_joint2, is 1.1"));
    EXPECT_THAT(monitor.violation()->fault.fingers, testing::ElementsAre(FingerIndex(1)));
  }
}

TEST_F(JointCouplingsTest, AJointOutsideItsRangeIsNamed) {
  const kinematics::HandFile hand = HandWith({});
  const plan::Plan plan = PlanFor(hand);
  HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  for (const double degrees : {0.9, 1.1}) {
    plan::HandState state = plan.hand->initial;
    state.pose.translation().z() += 1;
    state.joints[2][3] = hand.hand.fingers[2].joints[3].lower - Radians(degrees);
    world.Place(state);
    ExecutionMonitor monitor(world, solid(), kScale, {});
    monitor.Start();
    monitor.Watch(state.pose);
    ASSERT_EQ(monitor.violation().has_value(), degrees > 1);
    if (!monitor.violation()) continue;
    EXPECT_EQ(monitor.violation()->reason, Reason::kJointLimit);
    EXPECT_THAT(monitor.violation()->detail, HasSubstr("joint finger2_joint3 of finger 2"));
  }
}

/// The model has ratios, squares and constants of equalities, and tendons.
TEST_F(JointCouplingsTest, ResidualsAreThoseOfTheModelsEqualities) {
  const kinematics::HandFile hand = WithModel(
      HandWith({}),
      Edited(RingText(),
             {{"<actuator>",
               "<tendon><fixed name=\"a\"><joint joint=\"finger3_joint2\" coef=\"2\"/></fixed>"
               "<fixed name=\"b\"><joint joint=\"finger3_joint1\" coef=\"1\"/></fixed></tendon>"
               "<equality><joint joint1=\"finger0_joint3\" joint2=\"finger0_joint2\" "
               "polycoef=\"0.1 0.5 0.25 0 0\"/>"
               "<joint joint1=\"finger2_joint0\" polycoef=\"0.2 0 0 0 0\"/>"
               "<tendon tendon1=\"a\" tendon2=\"b\" polycoef=\"0 1 0 0 0\"/>"
               "</equality><actuator>"}}));
  HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  plan::HandState state;
  state.pose = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1));
  state.joints.assign(5, std::vector<double>(4, 0));
  const auto residual = [&](double joint2, double joint3, double fixed, double first,
                            double second) {
    state.joints[0][2] = joint2;
    state.joints[0][3] = joint3;
    state.joints[2][0] = fixed;
    state.joints[3][1] = first;
    state.joints[3][2] = second;
    world.Place(state);
    return world.largest_coupling_residual();
  };
  EXPECT_NEAR(residual(0.4, 0.1 + 0.2 + 0.04, 0.2, 0.6, 0.3).rad, 0, 1e-12);
  const JointCouplings::Residual quadratic = residual(0.4, 0.5, 0.2, 0.6, 0.3);
  EXPECT_EQ(quadratic.equality, 0);
  EXPECT_NEAR(quadratic.rad, 0.5 - 0.34, 1e-12);
  const JointCouplings::Residual constant = residual(0.4, 0.34, 0, 0.6, 0.3);
  EXPECT_EQ(constant.equality, 1);
  EXPECT_NEAR(constant.rad, 0.2, 1e-12);
  EXPECT_EQ(world.JointOfCoupling(1), std::pair(FingerIndex(2), 0));
  const JointCouplings::Residual tendons = residual(0.4, 0.34, 0.2, 0.6, 0.5);
  EXPECT_EQ(tendons.equality, 2);
  EXPECT_NEAR(tendons.rad, (2 * 0.5 - 0.6) / 2, 1e-12);
  EXPECT_EQ(world.JointOfCoupling(2), std::pair(FingerIndex(3), 2));
}

TEST_F(JointCouplingsTest, TheExportedSceneHoldsCoupledFingersInStockMuJoCo) {
  const kinematics::HandFile hand = CoupledHand();
  std::vector<SceneKey> keys;
  ReplayObserver observer;
  observer.on_rest = [&](const HandWorld& world, plan::EntryIndex entry) {
    keys.push_back({"rest " + std::to_string(entry), world.time(), world.Save().engine.qpos,
                    world.controls()});
  };
  static_cast<void>(ReplayHand(hand, solid(), PlanFor(hand), Options(), observer, 1));
  ASSERT_EQ(keys.size(), 1U);
  const mujoco::ModelPtr model = LoadStockScene(
      ExportHandScene(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass}, keys), folder_);
  const mujoco::DataPtr data(mj_makeData(model.get()));
  const int object = mj_name2id(model.get(), mjOBJ_BODY, "regrasp_object");
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mj_forward(model.get(), data.get());
  const Eigen::Vector3d before(data->xpos + 3 * object);
  const double begin = data->time;
  while (data->time < begin + 1) mj_step(model.get(), data.get());
  EXPECT_LT((Eigen::Vector3d(data->xpos + 3 * object) - before).norm(), 1e-3);
}

}  // namespace joint_couplings_test
}  // namespace regrasp::sim
