#include "sim/actuation/hand_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/mujoco/handles.h"
#include "planner/plan/plan.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_scene_export.h"
#include "tests/sim/actuation/edited_hand.h"
#include "tests/sim/actuation/model_fields.h"
#include "tests/sim/actuation/stock_scene.h"

namespace regrasp::sim {
namespace hand_world_test {

using plan::Reason;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kOptions[] = R"(<option timestep="0.001" cone="elliptic"/>)";
/// Each of these options would falsify a verdict.
constexpr char kOtherOptions[] =
    R"(<option timestep="0.004" gravity="0 0 9" wind="1 2 3" density="1000" viscosity="5"
       cone="pyramidal" impratio="1" iterations="1" tolerance="1" solver="CG" o_margin="1">
       <flag gravity="disable" limit="disable" equality="disable" contact="disable"
       clampctrl="disable" passive="disable" override="enable"/></option>)";

class HandWorldTest : public EditedHandTest {
 protected:
  [[nodiscard]] HandReplayOptions Options() const {
    HandReplayOptions options;
    options.mass_kg = kMass;
    return options;
  }
  [[nodiscard]] HandWorldOptions WorldOptions() const { return {.mu = kMu, .mass_kg = kMass}; }
  [[nodiscard]] kinematics::HandFile HandWithOtherOptions() const {
    return WithModel(HandWith({}), Edited(RingText(), {{kOptions, kOtherOptions}}));
  }
};

TEST_F(HandWorldTest, OptionsOfTheHandsModelDoNotDecide) {
  const HandWorld plain(HandWith({}), solid(), kScale, WorldOptions());
  const HandWorld other(HandWithOtherOptions(), solid(), kScale, WorldOptions());
  EXPECT_THAT(DifferentOptions(plain.model().opt, other.model().opt, 0), IsEmpty());
  EXPECT_THAT(DifferentFields(plain.model(), other.model(), 0), IsEmpty());
  EXPECT_NEAR(other.model().opt.gravity[2], -9.81, 1e-12);
}

TEST_F(HandWorldTest, TheObjectWeighsWhatItShouldWhateverTheModelDoesWithMasses) {
  const kinematics::HandFile scaled =
      WithModel(HandWith({}), Edited(RingText(), {{R"(autolimits="true"/>)",
                                                   R"(autolimits="true" settotalmass="0.5"/>)"}}));
  const mjModel& hand = *scaled.compiled->model;
  const HandWorld world(scaled, solid(), kScale, WorldOptions());
  const mjModel& model = world.model();
  const int object = mj_name2id(&model, mjOBJ_BODY, "regrasp_object");
  EXPECT_NEAR(model.body_mass[object], kMass, 1e-12);
  ASSERT_EQ(model.nbody, hand.nbody + 1);
  for (int body = 1; body < hand.nbody; ++body) {
    EXPECT_NEAR(model.body_mass[body], hand.body_mass[body], 1e-12 * hand.body_mass[body]);
    EXPECT_NEAR(model.body_inertia[3 * body], hand.body_inertia[3 * body],
                1e-9 * hand.body_inertia[3 * body]);
  }
}

/// Everything is equal except the documented differences in collision geometry: meshes, pairs,
/// names, keyframes.
TEST_F(HandWorldTest, TheExportedSceneIsTheModelOfTheReplay) {
  for (const kinematics::HandFile& hand :
       {HandWith({}), CoupledHand(), HandOnWrist(), HandWithOtherOptions()}) {
    const HandWorld world(hand, solid(), kScale, WorldOptions());
    const mujoco::ModelPtr scene =
        LoadStockScene(ExportHandScene(hand, solid(), kScale, WorldOptions(), {}), folder_);
    EXPECT_THAT(DifferentOptions(world.model().opt, scene->opt, 1e-12), ElementsAre("collision"));
    EXPECT_THAT(
        DifferentFields(world.model(), *scene, 1e-9,
                        {"qpos", "body_pos", "body_quat", "body_ipos", "body_iquat", "body_mass",
                         "body_inertia", "body_invweight0", "body_subtreemass", "jnt_", "dof_",
                         "eq_", "tendon_", "wrap_", "actuator_", "stat.meaninertia"}),
        IsEmpty());
    // Negative control: a changed mass, gravity or servo is detected.
    scene->body_mass[1] *= 1.001;
    scene->opt.gravity[2] = 0;
    scene->actuator_gainprm[0] *= 1.001;
    EXPECT_THAT(DifferentOptions(world.model().opt, scene->opt, 1e-12),
                ElementsAre("collision", "gravity"));
    EXPECT_THAT(DifferentFields(world.model(), *scene, 1e-9, {"body_mass", "actuator_gainprm"}),
                ElementsAre("body_mass", "actuator_gainprm"));
  }
}

/// Return the angle of the wrist after ten seconds under gravity.
double WristAngle(const mjModel& model, int wrist) {
  const mujoco::DataPtr data(mj_makeData(&model));
  while (data->time < 10) mj_step(&model, data.get());
  return std::abs(data->qpos[model.jnt_qposadr[wrist]]);
}

TEST_F(HandWorldTest, AWristDoesNotSinkUnderTheWeightOfTheHand) {
  const mujoco::ModelPtr model =
      LoadStockScene(ExportHandScene(HandOnWrist(), solid(), kScale, WorldOptions(), {}), folder_);
  const int wrist = mj_name2id(model.get(), mjOBJ_JOINT, "wrist");
  ASSERT_GE(wrist, 0);
  model->opt.gravity[1] = 9.81;  // about the axis of the wrist
  EXPECT_LT(WristAngle(*model, wrist), 1e-4);
  // Negative control: without damping the armature alone lets it sink.
  model->dof_damping[model->jnt_dofadr[wrist]] = 0;
  EXPECT_GT(WristAngle(*model, wrist), 1e-3);
}

/// Return edits that set the control range of each actuator.
std::vector<Edit> WithControlRanges(
    const std::function<std::array<double, 2>(int finger, int joint)>& range) {
  std::vector<Edit> edits;
  for (int f = 0; f < 5; ++f) {
    for (int k = 0; k < 4; ++k) {
      const std::string joint =
          "joint=\"finger" + std::to_string(f) + "_joint" + std::to_string(k) + "\"/>";
      const auto [lower, upper] = range(f, k);
      edits.push_back({joint, joint.substr(0, joint.size() - 2) + " ctrlrange=\"" +
                                  FormatDouble(lower) + " " + FormatDouble(upper) + "\"/>"});
    }
  }
  return edits;
}

/// Return the largest amount by which a control exceeds its range.
double LargestOutside(const HandWorld& world,
                      const std::function<std::array<double, 2>(int finger, int joint)>& range) {
  double largest = 0;
  const std::vector<double> controls = world.controls();
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const auto [lower, upper] = range(static_cast<int>(i) / 4, static_cast<int>(i) % 4);
    largest = std::max({largest, lower - controls[i], controls[i] - upper});
  }
  return largest;
}

TEST_F(HandWorldTest, ControlsStayInTheRangesOfTheModel) {
  const kinematics::HandFile plain = HandWith({});
  const plan::Plan plan = PlanFor(plain);
  // The ranges are those of the plan's joint angles. A servo exerts a force by a control beyond the
  // joint's angle.
  const auto narrow = [&](int f, int k) {
    std::array<double, 2> range = {plan.hand->initial.joints[f][k],
                                   plan.hand->initial.joints[f][k]};
    for (const plan::Step& step : plan.steps) {
      for (const plan::HandPath* path : plan::PathsOf(step)) {
        for (const plan::HandState& state : *path) {
          range[0] = std::min(range[0], state.joints[f][k]);
          range[1] = std::max(range[1], state.joints[f][k]);
        }
      }
    }
    return std::array<double, 2>{range[0] - 0.03, range[1] + 0.03};
  };
  double outside = 0;
  ReplayObserver observer;
  observer.on_time_step = [&](const HandWorld& world) {
    outside = std::max(outside, LargestOutside(world, narrow));
  };
  const ReplayResult free = ReplayHand(plain, solid(), plan, Options(), observer);
  EXPECT_EQ(free.steps.back().reason, Reason::kNone) << free.steps.back().detail;
  EXPECT_FALSE(free.settings.hand->limits.front().control);
  EXPECT_GT(outside, 0.01);
  outside = 0;
  const kinematics::HandFile limited = HandWith(WithControlRanges(narrow));
  const ReplayResult result = ReplayHand(limited, solid(), plan, Options(), observer);
  EXPECT_LE(outside, 1e-12);
  ASSERT_TRUE(result.settings.hand->limits.front().control);
  EXPECT_NEAR(result.settings.hand->limits.front().control->front(), narrow(0, 0)[0], 1e-12);
  // The contact forces are smaller than without the ranges, because controls are at their limits.
  double at_limit = 0;
  for (const StepReplay& step : result.steps) {
    at_limit = std::max(at_limit, step.hand->control_limit_s);
  }
  EXPECT_GT(at_limit, 0.05);
  for (const StepReplay& step : free.steps) EXPECT_EQ(step.hand->control_limit_s, 0);
}

TEST_F(HandWorldTest, WideRangesOfControlsChangeNothing) {
  const kinematics::HandFile plain = HandWith({});
  const plan::Plan plan = PlanFor(plain);
  const auto wide = [](int, int) { return std::array<double, 2>{-9, 9}; };
  const ReplayResult a = ReplayHand(plain, solid(), plan, Options());
  const ReplayResult b = ReplayHand(HandWith(WithControlRanges(wide)), solid(), plan, Options());
  ASSERT_EQ(a.steps.size(), b.steps.size());
  EXPECT_EQ(a.settings.grasp_force_N, b.settings.grasp_force_N);
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(b.steps[i].reason, Reason::kNone) << b.steps[i].detail;
    EXPECT_EQ(a.steps[i].displacement_m, b.steps[i].displacement_m);
  }
}

TEST_F(HandWorldTest, AnActuatorThatActsInOneDirectionIsRefused) {
  const kinematics::HandFile hand = HandWith({{"forcerange=\"-1.0 1.0\"", "forcerange=\"0 1.0\""}});
  try {
    const HandWorld world(hand, solid(), kScale, WorldOptions());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("force range of actuator finger0_motor0"));
    EXPECT_THAT(error.what(), testing::HasSubstr("found 0 to 1"));
  }
}

TEST_F(HandWorldTest, LimitsAreThoseOfTheModel) {
  const HandWorld plain(HandWith({}), solid(), kScale, WorldOptions());
  ASSERT_EQ(plain.limits().size(), 20U);
  for (const DriveLimits& limit : plain.limits()) EXPECT_EQ(limit.torque_Nm, 1);
  const DriveLimits last = plain.limits().back();
  EXPECT_EQ(last.finger, FingerIndex(4));
  EXPECT_EQ(last.joint, "finger4_joint3");
  EXPECT_EQ(last.actuator, "finger4_motor3");
  EXPECT_NEAR(last.upper_rad, 1.5708, 1e-4);
  const HandWorld strong(HandWith({{" forcerange=\"-1.0 1.0\"", ""}}), solid(), kScale,
                         WorldOptions());
  for (const DriveLimits& limit : strong.limits()) {
    EXPECT_EQ(limit.torque_Nm, std::numeric_limits<double>::infinity());
  }
  const HandWorld coupled(CoupledHand(), solid(), kScale, WorldOptions());
  EXPECT_EQ(coupled.limits().size(), 15U);
}

/// Return a URDF with three fingers of two joints each.
std::string UrdfText(const std::string& effort) {
  const std::string inertial =
      R"(<inertial><mass value="0.02"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0"
         iyz="0"/></inertial>)";
  const auto link = [&](const std::string& name, const std::string& z, const std::string& radius) {
    return "<link name=\"" + name + "\">" + inertial + "<collision><origin xyz=\"0 0 " + z +
           "\"/><geometry><sphere radius=\"" + radius + "\"/></geometry></collision></link>";
  };
  const auto joint = [&](const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& origin) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"" + origin +
           "\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" velocity=\"1\" effort=\"" +
           effort + "\"/></joint>";
  };
  std::string text = "<robot name=\"three\">" + link("palm", "-0.03", "0.02");
  const std::vector<std::pair<std::string, std::string>> fingers = {
      {"a", "0.06 0 0"}, {"b", "-0.06 0 0"}, {"c", "0 0.06 0"}};
  for (const auto& [finger, place] : fingers) {
    text += link(finger + "_near", "0.02", "0.01") + link(finger + "_tip", "0.03", "0.01") +
            joint(finger + "_1", "palm", finger + "_near", place) +
            joint(finger + "_2", finger + "_near", finger + "_tip", "0 0 0.04");
  }
  return text + "</robot>";
}

TEST_F(HandWorldTest, TheStrengthOfAUrdfsJointsIsItsEffort) {
  const auto path =
      Write("three.json",
            R"({"format": "regrasp-hand", "version": 1, "name": "three", "model": "three.urdf",
          "palm": "palm", "up": [0, 0, 1], "fingers": [
          {"name": "a", "tip": {"body": "a_tip", "centre": [0, 0, 0.03], "radius": 0.01}},
          {"name": "b", "tip": {"body": "b_tip", "centre": [0, 0, 0.03], "radius": 0.01}},
          {"name": "c", "tip": {"body": "c_tip", "centre": [0, 0, 0.03], "radius": 0.01}}]})");
  for (const std::string effort : {"0.75", " 0.75", "\t0.75 "}) {
    static_cast<void>(Write("three.urdf", UrdfText(effort)));
    const HandWorld world(kinematics::ReadHandFile(path), solid(), kScale, WorldOptions());
    ASSERT_EQ(world.limits().size(), 6U);
    for (const DriveLimits& limit : world.limits()) EXPECT_EQ(limit.torque_Nm, 0.75) << effort;
  }
}

/// A finger that does not reach the object has no contact to exert a force at.
TEST_F(HandWorldTest, AControllerOfFingersFarFromTheObjectAsksForNoForce) {
  const kinematics::HandFile hand = HandWith({});
  const plan::Plan plan = PlanFor(hand);
  for (const bool far : {true, false}) {
    HandWorld world(hand, solid(), kScale, WorldOptions());
    plan::HandState state = plan.hand->initial;
    if (far) state.pose.translation().z() += 1;
    world.Place(state);
    HandControl control(world, solid(), kScale, {std::atan(kMu), 1.2});
    Hold hold = {{}, 5};
    for (const plan::FingerContact& held : plan.initial) {
      control.Attach(held.finger);
      hold.fingers.push_back(held.finger);
    }
    control.SetHolding({hold, hold, 1, 1});
    for (int i = 0; i < 20; ++i) control.Step();
    double force = 0;
    for (const FingerIndex f : hold.fingers) force += control.force(f).norm();
    EXPECT_EQ(force > 0, !far);
  }
}

/// The links are too heavy to follow the plan, so that the replay fails with a reason.
TEST_F(HandWorldTest, AHandThatCannotFollowFailsWithAReason) {
  const kinematics::HandFile heavy = HandWith({{"armature=\"0.001\"", "armature=\"10\""}});
  const plan::Plan plan = PlanFor(heavy, 1.2);
  const ReplayResult result = ReplayHand(heavy, solid(), plan, Options());
  EXPECT_NE(result.steps.back().reason, Reason::kNone);
  EXPECT_FALSE(result.steps.back().detail.empty());
}

}  // namespace hand_world_test
}  // namespace regrasp::sim
