#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "planner/kinematics/finger_kinematics.h"
#include "planner/mujoco/handles.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/scene_model.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/scene/settings.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace hand_physics_test {

using Eigen::Vector3d;

constexpr double kPlateMu = 0.5;
constexpr double kPlateWeight = 0.981;
constexpr char kPlate[] = R"(<mujoco><worldbody>
    <geom name="tip" type="sphere" size="0.01" pos="0 0 -0.01" contype="0" conaffinity="0"/>
    <body name="plate" pos="0 0 0.005">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
      <joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 0 1"/>
      <geom type="box" size="0.1 0.1 0.005" mass="0.1" contype="0" conaffinity="0"/>
    </body></worldbody></mujoco>)";

/// A plate on top of a fixed fingertip at its centre, with the contact of the replay.
/// It moves along all axes and about the vertical axis.
class PlateOnTip {
 public:
  explicit PlateOnTip(const HandPhysics& physics) : physics_(physics) {
    mujoco::MemoryFiles files;
    files.Add("plate.xml", kPlate);
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML("plate.xml", files.get(), error.data(), error.size()));
    if (!model_) throw std::runtime_error(error.data());
    SetReplayOptions({0, 0, -9.81}, physics_, {}, *model_);
    model_->nconmax = 1;
    model_->njmax = 10;
    data_.reset(mj_makeData(model_.get()));
    Run(1, {});
  }

  /// Simulate under a force and a torque about the vertical axis on the plate.
  void Run(double seconds, const Vector3d& force, double torque = 0) {
    mjtNum* load = data_->xfrc_applied + 6;
    std::copy_n(force.data(), 3, load);
    load[5] = torque;
    const auto steps = static_cast<int>(std::lround(seconds / model_->opt.timestep));
    for (int i = 0; i < steps; ++i) Step();
  }
  /// Return the horizontal distance from the start, metres.
  [[nodiscard]] double distance() const { return std::hypot(data_->qpos[0], data_->qpos[1]); }
  [[nodiscard]] double angle() const { return std::abs(data_->qpos[3]); }
  [[nodiscard]] double depth() const { return -data_->qpos[2]; }
  [[nodiscard]] mjContact contact() const {
    const Vector3d below(-data_->qpos[0], -data_->qpos[1], 0);
    return MakeTipContact({below, -Vector3d::UnitZ(), data_->qpos[2]},
                          Eigen::Isometry3d(Eigen::Translation3d(-below)), kPlateMu, physics_);
  }

 private:
  void Step() {
    mj_fwdPosition(model_.get(), data_.get());
    mjContact made = contact();
    made.geom1 = 1;
    made.geom2 = 0;
    mj_addContact(model_.get(), data_.get(), &made);
    mj_makeConstraint(model_.get(), data_.get());
    mj_projectConstraint(model_.get(), data_.get());
    mj_fwdVelocity(model_.get(), data_.get());
    mj_step2(model_.get(), data_.get());
  }

  HandPhysics physics_;
  mujoco::ModelPtr model_;
  mujoco::DataPtr data_;
};

/// Return the rotation of the plate under a share of the torque that torsional friction resists.
double RotationUnder(double share, double torsion) {
  PlateOnTip plate({.torsion_m = torsion});
  plate.Run(0.3, Vector3d::Zero(), share * kPlateMu * 0.005 * kPlateWeight);
  return plate.angle();
}

TEST(HandPhysicsTest, TorsionalFrictionResistsATorqueBelowItsLimit) {
  EXPECT_LT(RotationUnder(0.9, 0.005), 0.01);
  EXPECT_GT(RotationUnder(1.5, 0.005), 0.05);
  EXPECT_GT(RotationUnder(0.9, 0), 0.05);
}

/// A contact that pivots has no static friction left: friction and its torque are on the ellipse
/// (f/μN)² + (τ/μNe)² = 1, and the velocities are normal to it. Under a force of share u of μN, the
/// contact creeps by e · u/√(1 − u²) per radian.
TEST(HandPhysicsTest, AContactThatPivotsCreepsUnderATangentialForce) {
  constexpr double kShare = 0.3;
  const auto creep_per_radian = [](double torsion) {
    PlateOnTip plate({.torsion_m = torsion});
    const double limit = kPlateMu * kPlateWeight;
    plate.Run(0.1, kShare * limit * Vector3d::UnitX(), 2 * torsion * limit);
    return plate.distance() / plate.angle();
  };
  const double expected = kShare / std::sqrt(1 - kShare * kShare);
  for (const double torsion : {0.002, 0.005}) {
    EXPECT_NEAR(creep_per_radian(torsion), expected * torsion, 0.1 * expected * torsion);
  }
}

/// Return the distance that the plate slides under a share of the friction limit μN.
double DistanceUnder(double share, const Vector3d& direction, bool pyramidal) {
  PlateOnTip plate({.pyramidal_cones = pyramidal});
  plate.Run(0.3, share * kPlateMu * kPlateWeight * direction.normalized());
  return plate.distance();
}

TEST(HandPhysicsTest, PyramidsResistLessAlongTheirDiagonals) {
  const Vector3d diagonal(1, 1, 0);
  EXPECT_LT(DistanceUnder(0.85, Vector3d::UnitX(), false), 1e-3);
  EXPECT_LT(DistanceUnder(0.85, diagonal, false), 1e-3);
  EXPECT_LT(DistanceUnder(0.85, Vector3d::UnitX(), true), 1e-3);
  EXPECT_GT(DistanceUnder(0.85, diagonal, true), 0.01);
  // The diagonal limit of a pyramid is μN/√2.
  EXPECT_LT(DistanceUnder(0.65, diagonal, true), 1e-3);
}

TEST(HandPhysicsTest, DefaultContactsAreThoseOfMujoco) {
  mjContact expected = {};
  mj_defaultSolRefImp(expected.solref, expected.solimp);
  const PlateOnTip soft({.contacts = TipContactModel::kDefault});
  const mjContact found = soft.contact();
  EXPECT_TRUE(std::ranges::equal(found.solref, expected.solref));
  EXPECT_TRUE(std::ranges::equal(found.solimp, expected.solimp));
  const PlateOnTip stiff({});
  EXPECT_FALSE(std::ranges::equal(stiff.contact().solref, expected.solref));
  EXPECT_GT(stiff.depth(), 0);
  EXPECT_GT(soft.depth(), 5 * stiff.depth());
}

class HandPhysicsWorldTest : public HeldInHand {
 protected:
  static constexpr FingerIndex kMovedFinger{0};

  /// Return a world without gravity and object forces, far from the object.
  [[nodiscard]] HandWorldOptions OptionsWith(const HandPhysics& physics) const {
    return {.mu = kMu, .mass_kg = kMass, .gravity_m_s2 = 0, .physics = physics};
  }
  /// Return the actuator torque of a joint in the first step under a command.
  [[nodiscard]] double FirstTorque(const HandPhysics& physics, double offset, double torque) const {
    HandWorld world(hand_, solid(), kScale, OptionsWith(physics));
    world.Place(plan_.hand->initial);
    Eigen::VectorXd torques = Eigen::VectorXd::Zero(4);
    kinematics::JointConfiguration target = world.configuration(kMovedFinger);
    target[1] += offset;
    torques[1] = torque;
    world.Command(kMovedFinger, target, torques);
    world.Step();
    return world.torque(kMovedFinger, 1);
  }
  /// Return the rotation of a free finger's joint under a constant torque in 0.1 s.
  [[nodiscard]] double RotationOfJoint(const HandPhysics& physics, double torque) const {
    HandWorld world(hand_, solid(), kScale, OptionsWith(physics));
    plan::HandState state = plan_.hand->initial;
    state.pose.translation().z() += 1;
    world.Place(state);
    const double start = world.configuration(kMovedFinger)[0];
    const auto steps = static_cast<int>(std::lround(0.1 / world.timestep()));
    for (int i = 0; i < steps; ++i) {
      world.Command(kMovedFinger, world.configuration(kMovedFinger),
                    torque * Eigen::VectorXd::Unit(4, 0));
      world.Step();
    }
    return std::abs(world.configuration(kMovedFinger)[0] - start);
  }
};

TEST_F(HandPhysicsWorldTest, TheGainFactorScalesTorquesThatTheControllerDoesNotExpect) {
  const double stiffness =
      HandWorld(hand_, solid(), kScale, OptionsWith({})).servo(kMovedFinger, 1).stiffness;
  const double expected = 0.05 * stiffness + 0.1;
  EXPECT_NEAR(FirstTorque({}, 0.05, 0.1), expected, 1e-9);
  EXPECT_NEAR(FirstTorque({.gain_factor = 0.8}, 0.05, 0.1), 0.8 * expected, 1e-9);
  EXPECT_NEAR(FirstTorque({.gain_factor = 1.2}, 0.05, 0.1), 1.2 * expected, 1e-9);
}

TEST_F(HandPhysicsWorldTest, JointFrictionResistsATorqueBelowIt) {
  const HandPhysics friction = {.joint_friction_Nm = 0.03};
  EXPECT_LT(RotationOfJoint(friction, 0.025), 2e-3);
  EXPECT_GT(RotationOfJoint(friction, 0.06), 0.02);
  EXPECT_GT(RotationOfJoint({}, 0.025), 0.01);
}

TEST_F(HandPhysicsWorldTest, TheTimeStepIsTheGivenOne) {
  for (const double timestep : {0.5e-3, 1e-3, 2e-3}) {
    HandWorld world(hand_, solid(), kScale, OptionsWith({.timestep_s = timestep}));
    world.Place(plan_.hand->initial);
    for (int i = 0; i < 10; ++i) world.Step();
    EXPECT_EQ(world.timestep(), timestep);
    EXPECT_NEAR(world.time(), 10 * timestep, 1e-12);
  }
}

/// The memory for constraints is enough for all contacts with the largest number of rows.
TEST_F(HandPhysicsWorldTest, AllRowsOfContactsFit) {
  const HandPhysics physics = {
      .pyramidal_cones = true, .torsion_m = 0.005, .joint_friction_Nm = 0.03};
  const HandWorld nominal(hand_, solid(), kScale, OptionsWith({}));
  const HandWorld world(hand_, solid(), kScale, OptionsWith(physics));
  EXPECT_EQ(world.model().njmax - nominal.model().njmax, 3 * world.model().nconmax);
}

}  // namespace hand_physics_test
}  // namespace regrasp::sim
