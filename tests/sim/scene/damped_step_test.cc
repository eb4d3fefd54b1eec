#include "sim/scene/damped_step.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/sim/mujoco_file.h"

namespace regrasp::sim {
namespace damped_step_test {

enum class Stepper { kDamped, kMujoco };

void Step(Stepper stepper, const mjModel& model, mjData& data) {
  stepper == Stepper::kDamped ? DampedStep(model, data, {}) : mj_step(&model, &data);
}

/// A heavy plate and a light fingertip of 10 g on damped slides, which is pressed against it.
std::string PressedTip(double timestep) {
  return R"(<mujoco><option timestep=")" + std::to_string(timestep) +
         R"(" cone="elliptic" impratio="100" gravity="0 0 0"/>
  <worldbody>
    <body name="plate" pos="0 0 -0.01">
      <joint name="plate" type="slide" axis="1 0 0"/>
      <geom type="box" size="0.1 0.1 0.01" mass="1000" friction="0.8"/>
    </body>
    <body name="tip" pos="0 0 0.01">
      <joint name="x" type="slide" axis="1 0 0" damping="100"/>
      <joint name="z" type="slide" axis="0 0 1" damping="100"/>
      <geom type="sphere" size="0.01" mass="0.01" friction="0.8" solref="0.005 1"
            solimp="0.99 0.99 0.001"/>
    </body>
  </worldbody>
  <actuator><motor joint="plate"/><motor joint="z"/></actuator></mujoco>)";
}

/// Return the largest distance that the fingertip slips on the plate, which moves to and fro by 1
/// mm with 2 Hz, metres. The damping force of the fingertip is inside the friction cone.
double LargestSlip(Stepper stepper, double timestep, mjtIntegrator integrator = mjINT_EULER) {
  constexpr double kPressing = 2;
  constexpr double kMass = 1000;
  constexpr double kAmplitude = 1e-3;
  constexpr double kRate = 2 * std::numbers::pi * 2;
  const ModelPtr model = LoadFromFile(PressedTip(timestep));
  model->opt.integrator = integrator;
  const DataPtr data(mj_makeData(model.get()));
  data->qpos[0] = -kAmplitude;
  double slip = 0;
  double begin = 0;
  while (data->time < 1.2) {
    data->ctrl[0] = kMass * kAmplitude * kRate * kRate * std::cos(kRate * data->time);
    data->ctrl[1] = -kPressing;
    Step(stepper, *model, *data);
    const double place = data->qpos[1] - data->qpos[0];
    if (data->time < 0.2) begin = place;
    slip = std::max(slip, std::abs(place - begin));
  }
  return slip;
}

TEST(DampedStepTest, SlipOfAStickingTipDoesNotDependOnTheTimeStep) {
  const double fine = LargestSlip(Stepper::kDamped, 1e-4);
  EXPECT_NEAR(LargestSlip(Stepper::kDamped, 1e-3), fine, 0.2 * fine);
  EXPECT_NEAR(LargestSlip(Stepper::kDamped, 2e-3), fine, 0.20 * fine);
  // Both steps converge to the same motion.
  EXPECT_NEAR(LargestSlip(Stepper::kMujoco, 1e-5), fine, 0.3 * fine);
  // MuJoCo's own step is the negative control.
  EXPECT_GT(LargestSlip(Stepper::kMujoco, 1e-3), 20 * fine);
  EXPECT_GT(LargestSlip(Stepper::kMujoco, 1e-3, mjINT_IMPLICIT), 20 * fine);
}

/// A two-link finger above a ball, with a servo.
std::string Finger(double damping, double servo_damping, double gravity) {
  const std::string joint = R"(axis="0 1 0" damping=")" + std::to_string(damping);
  return R"(<mujoco><option timestep="0.001" gravity="0 0 )" + std::to_string(gravity) +
         R"("/><worldbody>
    <geom type="sphere" size="0.02" pos="0.05 0 -0.05"/>
    <body><joint name="a" )" +
         joint + R"("/><geom type="capsule" fromto="0 0 0 0.04 0 0" size="0.008"/>
      <body pos="0.04 0 0"><joint name="b" )" +
         joint + R"("/><geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.007"/></body>
    </body></worldbody>
  <tendon><fixed name="both"><joint joint="a" coef="1"/><joint joint="b" coef="0.5"/></fixed></tendon>
  <actuator><general tendon="both" biastype="affine" gainprm="1" biasprm="0 -1 -)" +
         std::to_string(servo_damping) + R"("/></actuator></mujoco>)";
}

/// Return the joint angles of the finger after some steps.
std::vector<double> AnglesAfter(Stepper stepper, const ModelPtr& model, int steps,
                                double control = 0.3) {
  const DataPtr data(mj_makeData(model.get()));
  data->ctrl[0] = control;
  for (int i = 0; i < steps; ++i) Step(stepper, *model, *data);
  return {data->qpos, data->qpos + model->nq};
}

TEST(DampedStepTest, WithoutDampingItIsTheStepOfMujoco) {
  const ModelPtr model = LoadFromFile(Finger(0, 0, -9.81));
  const std::vector<double> angles = AnglesAfter(Stepper::kDamped, model, 300);
  EXPECT_GT(std::abs(angles[0]), 0.1);
  EXPECT_EQ(angles, AnglesAfter(Stepper::kMujoco, model, 300));
}

TEST(DampedStepTest, WithoutContactItIsTheImplicitStepOfMujoco) {
  // Slow motions, so that the velocities do not change the inertia.
  constexpr double kSmall = 1e-3;
  const ModelPtr joints = LoadFromFile(Finger(0.02, 0, 0));
  const std::vector<double> damped = AnglesAfter(Stepper::kDamped, joints, 20, kSmall);
  const std::vector<double> euler = AnglesAfter(Stepper::kMujoco, joints, 20, kSmall);
  // Damping by a tendon's servo couples both joints.
  const ModelPtr servo = LoadFromFile(Finger(0, 0.02, 0));
  const std::vector<double> driven = AnglesAfter(Stepper::kDamped, servo, 20, kSmall);
  servo->opt.integrator = mjINT_IMPLICIT;
  const std::vector<double> implicit = AnglesAfter(Stepper::kMujoco, servo, 20, kSmall);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(std::abs(damped[i]), 1e-6);
    EXPECT_NEAR(damped[i], euler[i], 1e-9 * std::abs(euler[i]));
    EXPECT_NEAR(driven[i], implicit[i], 1e-3 * std::abs(implicit[i]));
    EXPECT_GT(std::abs(driven[i] - damped[i]), 1e-2 * std::abs(damped[i]));
  }
}

TEST(DampedStepTest, ActuatorsWithStatesKeepTheStepOfMujoco) {
  std::string text = PressedTip(1e-3);
  const std::string motor = R"(<motor joint="z"/>)";
  text.replace(text.find(motor), motor.size(),
               R"(<general joint="z" dyntype="filter" dynprm="0.01"/>)");
  const ModelPtr model = LoadFromFile(text);
  ASSERT_EQ(model->na, 1);
  const std::vector<double> positions = AnglesAfter(Stepper::kDamped, model, 200, 1e4);
  EXPECT_GT(std::abs(positions[0]), 1e-3);
  EXPECT_EQ(positions, AnglesAfter(Stepper::kMujoco, model, 200, 1e4));
}

}  // namespace damped_step_test
}  // namespace regrasp::sim
