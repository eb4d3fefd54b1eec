#include "sim/actuation/ode_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/entry_replay.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/edited_hand.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace ode_hand_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using kinematics::JointConfiguration;
using plan::Reason;

constexpr double kGravity = 9.81;
constexpr double kForce = 5;  ///< grasp force, newtons

class OdeHandTest : public HeldInHand {
 protected:
  [[nodiscard]] HandWorldOptions WorldOptions() const { return {.mu = kMu, .mass_kg = kMass}; }
  [[nodiscard]] HandReplayOptions Options(EngineChoice engine) const {
    HandReplayOptions options;
    options.mass_kg = kMass;
    options.engine = engine;
    return options;
  }
  /// Let a hand take hold of the object.
  void Hold(HandEngine& world) const {
    world.Place(plan_.hand->initial);
    const HandReplayOptions options = Options(EngineChoice::kOde);
    const std::vector<double> forces(plan_.steps.size() + 1, kForce);
    EntryReplay replay(world, solid(), plan_, {plan_.friction_angle, kMass * kGravity, {}}, forces,
                       options, {});
    const StepReplay step = replay.Carry(plan::EntryIndex(0));
    ASSERT_EQ(step.reason, Reason::kNone) << step.detail;
  }
  [[nodiscard]] Reason ReasonUnder(const HandReplayOptions& options) const {
    return ReplayHand(hand_, solid(), plan_, options).steps.back().reason;
  }
};

/// Return targets that move all joints of a finger by a tenth of a radian at 1 and 3 Hz, inside
/// their ranges. Stops are soft in MuJoCo and hard in ODE.
JointConfiguration Wave(const kinematics::Finger& chain, const JointConfiguration& start,
                        double time) {
  constexpr double kInside = 0.05;
  JointConfiguration target = start;
  for (int i = 0; i < target.size(); ++i) {
    const double rate = i % 2 == 0 ? 1 : 3;
    target[i] += 0.1 * std::sin(2 * M_PI * rate * time);
    target[i] = std::clamp(target[i], chain.lower[i] + kInside, chain.upper[i] - kInside);
  }
  return target;
}

/// Return the motion of the joints of a finger that does not move its point at a place.
JointConfiguration SelfMotion(const kinematics::Finger& chain, const JointConfiguration& joints,
                              const Vector3d& place) {
  const kinematics::JointFrames frames = kinematics::FramesOf(chain, joints);
  Eigen::Matrix3Xd jacobian(3, joints.size());
  for (int k = 0; k < joints.size(); ++k) {
    jacobian.col(k) =
        (frames[k].linear() * chain.joints[k].axis).cross(place - frames[k].translation());
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeFullV);
  return svd.matrixV().rightCols<1>();
}

/// Servos, damping, armature, weight and inertia agree with those of MuJoCo.
TEST_F(OdeHandTest, AHandWithoutContactMovesAsInMujoco) {
  HandWorld mujoco(hand_, solid(), kScale, WorldOptions());
  OdeHand ode(hand_, solid(), kScale, WorldOptions());
  plan::HandState start = plan_.hand->initial;
  start.pose.translation() -= hand_.hand.up;  // the object falls away
  double largest = 0;
  double range = 0;
  for (HandEngine* world : std::vector<HandEngine*>{&mujoco, &ode}) world->Place(start);
  const JointConfiguration first = mujoco.configuration(FingerIndex(0));
  for (int i = 0; i < 1000; ++i) {
    for (HandEngine* world : std::vector<HandEngine*>{&mujoco, &ode}) {
      for (FingerIndex f{0}; f < std::ssize(hand_.hand.fingers); ++f) {
        const JointConfiguration target =
            Wave(hand_.hand.fingers[f], ConfigurationOf(hand_.hand.fingers[f], start.joints[f]),
                 1e-3 * i);
        world->Command(f, target, Eigen::VectorXd::Zero(target.size()));
      }
      world->Step();
    }
    for (FingerIndex f{0}; f < std::ssize(hand_.hand.fingers); ++f) {
      const JointConfiguration off = mujoco.configuration(f) - ode.configuration(f);
      largest = std::max(largest, off.cwiseAbs().maxCoeff());
    }
    range = std::max(range, (mujoco.configuration(FingerIndex(0)) - first).cwiseAbs().maxCoeff());
  }
  RecordProperty("largest_difference_urad", static_cast<int>(1e6 * largest));
  EXPECT_LT(largest, 1e-3);  // 3e-5 with equal time steps
  EXPECT_GT(range, 0.08);
}

/// A pinned or released object without contact stays or falls as it must.
TEST_F(OdeHandTest, AnObjectWithoutContactFalls) {
  OdeHand world(hand_, solid(), kScale, WorldOptions());
  plan::HandState start = plan_.hand->initial;
  start.pose.translation() += Vector3d(0, 0, 1);
  world.Place(start);
  world.PinObject(true);
  for (int i = 0; i < 100; ++i) world.Step();
  EXPECT_TRUE(world.object_pose().isApprox(start.pose, 1e-12));
  world.PinObject(false);
  for (int i = 0; i < 100; ++i) world.Step();
  const double fallen = kGravity * 0.25e-6 * 200 * 201 / 2;  // semi-implicit steps of 0.5 ms
  EXPECT_NEAR((world.object_pose().translation() - start.pose.translation()).dot(hand_.hand.up),
              -fallen, 1e-9);
}

/// With constant controls the contact forces sum to the weight, and the object does not creep.
TEST_F(OdeHandTest, AHeldObjectRests) {
  OdeHand world(hand_, solid(), kScale, WorldOptions());
  Hold(world);
  for (int i = 0; i < 2000; ++i) world.Step();
  const Isometry3d start = world.object_pose();
  for (int i = 0; i < 1000; ++i) world.Step();
  const double creep = (world.object_pose().translation() - start.translation()).norm();
  RecordProperty("creep_nm_per_s", static_cast<int>(1e9 * creep));
  EXPECT_LT(creep, 1e-6);
  Vector3d sum = Vector3d::Zero();
  for (FingerIndex f{0}; f < std::ssize(hand_.hand.fingers); ++f) {
    const TipTouch touch = world.touch(f);
    const double normal = touch.force.dot(world.object_pose().linear() * touch.inward_O);
    EXPECT_GE(normal, 0);
    EXPECT_LE(touch.force.norm(), normal * std::hypot(1, kMu) * (1 + 1e-4));
    sum += touch.force;
  }
  EXPECT_NEAR((sum - kMass * kGravity * hand_.hand.up).norm(), 0, 1e-3);
}

/// Rolling without slip moves the centre of a sphere by Δθ × (r n). The kinematics of the test are
/// those of the planner, not of the engine.
TEST_F(OdeHandTest, AFingertipRollsWithoutSlip) {
  OdeHand world(hand_, solid(), kScale, WorldOptions());
  Hold(world);
  world.PinObject(true);
  const FingerIndex f = plan_.initial.front().finger;
  const kinematics::Finger& chain = hand_.hand.fingers[f];
  const JointConfiguration start = world.configuration(f);
  const TipTouch first = world.touch(f);
  JointConfiguration target = start;
  JointConfiguration last = SelfMotion(chain, start, world.object_pose() * first.point_O);
  double rolled = 0;
  Vector3d slip = Vector3d::Zero();
  for (int i = 0; i < 500; ++i) {
    const Vector3d n = -(world.object_pose().linear() * world.touch(f).inward_O);
    const Eigen::Matrix3d turn =
        kinematics::FramesOf(chain, world.configuration(f)).back().linear();
    const Vector3d centre = world.tip(f);
    const Vector3d at = world.object_pose() * world.touch(f).point_O;
    const JointConfiguration way_of_joints = SelfMotion(chain, world.configuration(f), at);
    target += (way_of_joints.dot(last) < 0 ? -1 : 1) * 1e-3 * way_of_joints;
    last = target - start;
    world.Command(f, target, world.BalancingTorques(f, at, first.force));
    world.Step();
    const Eigen::AngleAxisd change(
        kinematics::FramesOf(chain, world.configuration(f)).back().linear() * turn.transpose());
    const Vector3d way = (change.angle() * change.axis()).cross(chain.tip.radius * n);
    const Vector3d off = world.tip(f) - centre - way;
    rolled += way.norm();
    slip += off - off.dot(n) * n;
  }
  RecordProperty("rolled_um", static_cast<int>(1e6 * rolled));
  RecordProperty("slip_nm", static_cast<int>(1e9 * slip.norm()));
  EXPECT_GT(rolled, 3e-4);
  EXPECT_LT(slip.norm(), 0.02 * rolled);
}

TEST_F(OdeHandTest, ActuatorsKeepTheirLimits) {
  HandWorldOptions options = WorldOptions();
  options.force_factor = 0.05;
  OdeHand world(hand_, solid(), kScale, options);
  world.Place(plan_.hand->initial);
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    for (FingerIndex f{0}; f < std::ssize(hand_.hand.fingers); ++f) {
      const JointConfiguration now = world.configuration(f);
      world.Command(f, now, Eigen::VectorXd::Constant(now.size(), i < 100 ? 1 : -1));
    }
    world.Step();
    for (FingerIndex f{0}; f < std::ssize(hand_.hand.fingers); ++f) {
      for (int drive = 0; drive < hand_.hand.fingers[f].drives; ++drive) {
        largest = std::max(largest, world.load_share(f, drive));
      }
    }
  }
  EXPECT_NEAR(largest, 1, 1e-9);
}

TEST_F(OdeHandTest, ARestoredStateContinuesIdentically) {
  OdeHand world(hand_, solid(), kScale, WorldOptions());
  Hold(world);
  const HandEngine::State state = world.Save();
  std::vector<Isometry3d> ends;
  for (int run = 0; run < 2; ++run) {
    world.Restore(state);
    for (int i = 0; i < 50; ++i) world.Step();
    ends.push_back(world.object_pose());
    for (int i = 0; i < 20; ++i) world.Step();
  }
  EXPECT_EQ(ends[0].matrix(), ends[1].matrix());
}

TEST_F(OdeHandTest, APlanPassesInBothEngines) {
  const ReplayResult result = ReplayHand(hand_, solid(), plan_, Options(EngineChoice::kBoth));
  ASSERT_EQ(result.steps.size(), plan_.steps.size() + 1);
  EXPECT_EQ(result.settings.engine, EngineChoice::kBoth);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
    ASSERT_TRUE(step.ode && step.ode_hand);
    EXPECT_EQ(step.ode->reason, Reason::kNone) << step.ode->detail;
    // They are two engines: results are close and never equal.
    EXPECT_NE(step.hand->off_m, step.ode_hand->off_m);
    EXPECT_NEAR(step.hand->off_m, step.ode_hand->off_m, 1e-3);
  }
}

TEST_F(OdeHandTest, NegativeControlsFail) {
  HandReplayOptions slippery = Options(EngineChoice::kOde);
  slippery.friction_factor = 0.05;
  EXPECT_NE(ReasonUnder(slippery), Reason::kNone);
  HandReplayOptions heavy = Options(EngineChoice::kOde);
  heavy.mass_factor = 10;
  EXPECT_NE(ReasonUnder(heavy), Reason::kNone);
  HandReplayOptions away = Options(EngineChoice::kOde);
  away.start_shift_m = {0, 0, 1};  // no fingertip makes contact
  EXPECT_NE(ReasonUnder(away), Reason::kNone);
}

TEST_F(OdeHandTest, PhysicsOfMujocoAloneIsRefused) {
  HandReplayOptions options = Options(EngineChoice::kOde);
  options.physics.torsion_m = 5e-3;
  EXPECT_THROW(static_cast<void>(ReplayHand(hand_, solid(), plan_, options)), InputError);
  options.physics = {.pyramidal_cones = true};
  EXPECT_THROW(static_cast<void>(ReplayHand(hand_, solid(), plan_, options)), InputError);
}

class OdeHandModelTest : public EditedHandTest {
 protected:
  /// Return a hand whose last two joints of each finger share an actuator by a tendon, as in the
  /// Shadow hand.
  [[nodiscard]] kinematics::HandFile TendonHand() const {
    std::vector<Edit> edits;
    std::string tendons = "<tendon>";
    for (int f = 0; f < 5; ++f) {
      const std::string finger = "finger" + std::to_string(f);
      edits.push_back(
          {"<position name=\"" + finger + "_motor3\" joint=\"" + finger + "_joint3\"/>", ""});
      edits.push_back({"joint=\"" + finger + "_joint2\"/>", "tendon=\"" + finger + "\"/>"});
      tendons += "<fixed name=\"" + finger + "\"><joint joint=\"" + finger +
                 "_joint2\" coef=\"1\"/><joint joint=\"" + finger +
                 "_joint3\" coef=\"1\"/></fixed>";
    }
    edits.push_back({"<actuator>", tendons + "</tendon><actuator>"});
    return HandWith(edits, true);
  }
  [[nodiscard]] HandWorldOptions WorldOptions() const { return {.mu = kMu, .mass_kg = kMass}; }
};

/// Return a state of a hand with the object below it.
plan::HandState Apart(const kinematics::HandModel& hand, double share) {
  plan::HandState state;
  state.pose.translation() = -hand.up;
  for (const kinematics::Finger& finger : hand.fingers) {
    state.joints.push_back(
        kinematics::JointAngles(finger, finger.lower + share * (finger.upper - finger.lower)));
  }
  return state;
}

/// Return the derivative of the potential energy of a hand by an independent joint, newton metres.
/// Positions are those of the compiled model.
/// @param joints  step of each joint of the finger per step of the independent joint.
double Slope(const kinematics::HandFile& file, const plan::HandState& state, FingerIndex finger,
             const std::vector<double>& joints) {
  constexpr double kStep = 1e-5;
  const mjModel& model = *file.compiled->model;
  const kinematics::DataPtr data = kinematics::AtRest(model);
  const auto energy = [&](double step) {
    for (FingerIndex f{0}; f < std::ssize(file.hand.fingers); ++f) {
      for (std::size_t k = 0; k < file.hand.fingers[f].joints.size(); ++k) {
        const int joint =
            mj_name2id(&model, mjOBJ_JOINT, file.hand.fingers[f].joints[k].name.c_str());
        data->qpos[model.jnt_qposadr[joint]] =
            state.joints[f][k] + (f == finger ? step * joints[k] : 0);
      }
    }
    mj_kinematics(&model, data.get());
    double sum = 0;
    for (int body = 1; body < model.nbody; ++body) {
      const Eigen::Map<const Vector3d> centre(data->xipos + std::ptrdiff_t{3} * body);
      sum += kGravity * model.body_mass[body] * centre.dot(file.hand.up);
    }
    return sum;
  };
  return (energy(kStep) - energy(-kStep)) / (2 * kStep);
}

/// The torque of a motionless coupled actuator balances the weight of both links by the principle
/// of virtual work.
TEST_F(OdeHandModelTest, CoupledJointsAreInEquilibrium) {
  for (const kinematics::HandFile& hand : {CoupledHand(), TendonHand()}) {
    OdeHand world(hand, solid(), kScale, WorldOptions());
    world.Place(Apart(hand.hand, 0.4));
    world.PinObject(true);
    const FingerIndex f{1};
    const int drive = 2;
    const JointConfiguration target = world.configuration(f);
    world.Command(f, target, Eigen::VectorXd::Zero(target.size()));
    for (int i = 0; i < 4000; ++i) world.Step();
    const plan::HandState state = world.state();
    const double weight = Slope(hand, state, f, {0, 0, 1, 1});
    EXPECT_NEAR(world.torque(f, drive), weight, 1e-6);
    EXPECT_GT(std::abs(weight), 1e-4);
    // The servo is off its target by the torque over its stiffness.
    EXPECT_NEAR(world.servo(f, drive).stiffness * (target[drive] - world.configuration(f)[drive]),
                weight, 1e-6);
    // Negative control: the weight about one of the joints differs.
    EXPECT_GT(std::abs(world.torque(f, drive) - Slope(hand, state, f, {0, 0, 1, 0})), 1e-5);
  }
}

/// Coupled joints follow a wave of targets as in MuJoCo, whose coupling yields a little.
TEST_F(OdeHandModelTest, CoupledJointsMoveAsInMujoco) {
  for (const kinematics::HandFile& hand : {CoupledHand(), TendonHand()}) {
    HandWorld mujoco(hand, solid(), kScale, WorldOptions());
    OdeHand ode(hand, solid(), kScale, WorldOptions());
    const plan::HandState start = Apart(hand.hand, 0.4);
    double largest = 0;
    double range = 0;
    double uncoupled = 0;
    for (HandEngine* world : std::vector<HandEngine*>{&mujoco, &ode}) world->Place(start);
    const JointConfiguration first = ode.configuration(FingerIndex(0));
    for (int i = 0; i < 1000; ++i) {
      for (HandEngine* world : std::vector<HandEngine*>{&mujoco, &ode}) {
        for (FingerIndex f{0}; f < std::ssize(hand.hand.fingers); ++f) {
          const kinematics::Finger& chain = hand.hand.fingers[f];
          JointConfiguration target =
              Wave(chain, kinematics::ConfigurationAt(chain, start.joints[f]), 1e-3 * i);
          if (i >= 500) target[2] -= 0.1;  // a step
          world->Command(f, target, Eigen::VectorXd::Zero(target.size()));
        }
        world->Step();
      }
      for (FingerIndex f{0}; f < std::ssize(hand.hand.fingers); ++f) {
        const JointConfiguration off = mujoco.configuration(f) - ode.configuration(f);
        largest = std::max(largest, off.cwiseAbs().maxCoeff());
        const std::vector<double> joints = ode.joint_angles_of(f);
        uncoupled = std::max(uncoupled, std::abs(joints[3] - joints[2]));
      }
      range = std::max(range, std::abs((ode.configuration(FingerIndex(0)) - first)[2]));
    }
    RecordProperty("largest_difference_urad", static_cast<int>(1e6 * largest));
    EXPECT_LT(largest, 3e-3);
    EXPECT_GT(range, 0.15);
    EXPECT_LT(uncoupled, 1e-12);
  }
}

/// A plan of a coupled hand passes in ODE, and fails there without friction.
TEST_F(OdeHandModelTest, APlanOfACoupledHandPasses) {
  const kinematics::HandFile hand = TendonHand();
  const plan::Plan plan = PlanFor(hand);
  HandReplayOptions options;
  options.mass_kg = kMass;
  options.engine = EngineChoice::kBoth;
  for (const StepReplay& step : ReplayHand(hand, solid(), plan, options).steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
    ASSERT_TRUE(step.ode);
    EXPECT_EQ(step.ode->reason, Reason::kNone) << step.ode->detail;
  }
  options.engine = EngineChoice::kOde;
  options.friction_factor = 0.05;
  EXPECT_NE(ReplayHand(hand, solid(), plan, options).steps.back().reason, Reason::kNone);
}

TEST_F(OdeHandModelTest, AJointBetweenCoupledJointsIsRefused) {
  kinematics::HandFile hand = HandWith({}, true);
  kinematics::Finger& finger = hand.hand.fingers[0];
  std::swap(finger.joints[1].drive, finger.joints[2].drive);
  try {
    const OdeHand world(hand, solid(), kScale, WorldOptions());
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("engine ode: joint finger0_joint2 between coupled joints"));
  }
}

TEST_F(OdeHandModelTest, AHandOnAWristIsFixed) {
  const object::ObjectFile cube = object::ReadObject(ProjectPath("models/cube.obj"));
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*cube.object);
  const HandWorldOptions options = {.mu = kMu, .mass_kg = kMass};
  const OdeHand plain(HandWith({}), solid, kScale, options);
  const OdeHand wrist(HandOnWrist(), solid, kScale, options);
  for (FingerIndex f{0}; f < 5; ++f) EXPECT_TRUE(plain.tip(f).isApprox(wrist.tip(f), 1e-12));
}

}  // namespace ode_hand_test
}  // namespace regrasp::sim
