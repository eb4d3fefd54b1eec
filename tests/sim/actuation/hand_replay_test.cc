#include "sim/actuation/hand_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/projection.h"
#include "sim/scene/scaling.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace hand_replay_test {

using Eigen::Vector3d;
using plan::Reason;

const kinematics::HandFile& Hand() {
  static const kinematics::HandFile file =
      kinematics::ReadHandFile(ProjectPath("models/hands/ring5.json"));
  return file;
}

const object::Polyhedron& Cube() {
  static const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

constexpr double kScale = 0.8333;  // edge length of 5 cm
constexpr double kMu = 0.8;

HandReplayOptions Options() {
  HandReplayOptions options;
  options.mass_kg = 0.125;
  return options;
}

ReplayResult ReplayOf(const plan::Plan& plan, const HandReplayOptions& options = Options()) {
  return ReplayHand(Hand(), Cube(), plan, options);
}

Reason ReasonOf(const ReplayResult& result) { return result.steps.back().reason; }

/// Return a plan that passes: a rotation of 150° with a finger switch and without a sliding step.
/// It is made once.
const plan::Plan& GoodPlan() {
  static const plan::Plan plan = [] {
    constexpr int kSeeds = 30;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      gait::GaitRequest request;
      request.hand = &Hand().hand;
      request.solid = &Cube();
      request.scale = kScale;
      request.criteria.friction_angle = std::atan(kMu);
      request.criteria.min_quality = 0.06;
      request.turn = {Vector3d::UnitZ(), Radians(150)};
      request.seed = seed;
      const gait::GaitResult found = gait::FindGait(request);
      if (!found.gait) continue;
      const plan::Plan made =
          plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
      const bool switches = std::ranges::any_of(made.steps, [](const plan::Step& step) {
        return std::holds_alternative<plan::Switch>(step);
      });
      const bool aligns = std::ranges::any_of(made.steps, [](const plan::Step& step) {
        return std::holds_alternative<plan::Align>(step);
      });
      if (switches && !aligns && ReasonOf(ReplayOf(made)) == Reason::kNone) return made;
    }
    ADD_FAILURE() << "no plan passes";
    return plan::Plan();
  }();
  return plan;
}

TEST(HandReplayTest, AGoodPlanEndsWhereItShouldWithinTheToleranceAllAlong) {
  const ReplayResult result = ReplayOf(GoodPlan());
  ASSERT_EQ(result.steps.size(), GoodPlan().steps.size() + 1);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
    ASSERT_TRUE(step.hand);
    EXPECT_LE(step.hand->off_m, 2e-3);
    EXPECT_LE(step.hand->rest_off_m, 1e-3);
    EXPECT_LE(step.hand->slip_m, 1e-3);
    EXPECT_LT(step.hand->torque_share, 1);
    EXPECT_GT(step.hand->simulated_s, 0);
    EXPECT_GE(step.snapshot.fingers.size(), 3U);
    // The contact forces support the weight, up to the force that the servos add.
    Vector3d sum = Vector3d::Zero();
    for (const plan::FingerState& finger : step.snapshot.fingers) sum += finger.force_W;
    EXPECT_NEAR(sum.norm(), 0.125 * kGravity, 0.05) << step.index;
  }
}

/// The position error of a finger at contact must not become a lasting unplanned force against the
/// other fingers.
TEST(HandReplayTest, AtRestFingersPushAsHardAsIsPlannedAlsoAfterSwitches) {
  const ReplayResult result = ReplayOf(GoodPlan());
  for (const StepReplay& step : result.steps) {
    double normal = 0;
    for (const plan::FingerState& finger : step.snapshot.fingers) {
      normal += finger.force_W.dot(finger.normal_W);
    }
    EXPECT_NEAR(normal, step.hand->grasp_force_N, 0.06 * step.hand->grasp_force_N) << step.index;
  }
}

TEST(HandReplayTest, TheSamePlanGivesTheSameBits) {
  const ReplayResult a = ReplayOf(GoodPlan());
  const ReplayResult b = ReplayOf(GoodPlan());
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(a.steps[i].hand->off_m, b.steps[i].hand->off_m);
    EXPECT_EQ(a.steps[i].hand->rest_off_rad, b.steps[i].hand->rest_off_rad);
    EXPECT_EQ(a.steps[i].hand->slip_m, b.steps[i].hand->slip_m);
  }
}

/// Return the friction angle that the weakest static grasp of a plan requires.
double NeededFrictionAngle(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  double most = 0;
  const auto look = [&] {
    const auto required =
        grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(holding), Cube().wrench_frame());
    most = std::max(most, required->upper);
  };
  look();
  for (const plan::Step& step : plan.steps) {
    holding = plan::GraspAfter(holding, step);
    look();
  }
  return most;
}

TEST(HandReplayTest, NothingHoldsAtNineTenthsOfTheFrictionThatIsNeeded) {
  HandReplayOptions options = Options();
  options.friction_factor = 0.9 * std::tan(NeededFrictionAngle(GoodPlan())) / kMu;
  ASSERT_LT(options.friction_factor, 1);
  const ReplayResult result = ReplayOf(GoodPlan(), options);
  EXPECT_THAT(ReasonOf(result), testing::AnyOf(Reason::kSlipped, Reason::kObjectMoved,
                                               Reason::kContactLost, Reason::kHandCollides))
      << result.steps.back().detail;
}

TEST(HandReplayTest, AnObjectThatIsTooHeavyFalls) {
  const double grasp_force = ReplayOf(GoodPlan()).settings.grasp_force_N;
  HandReplayOptions options = Options();
  // The faces are vertical, so friction supports at most μ times the grasp force: 20 % too much.
  options.mass_factor = 1.2 * kMu * grasp_force / (*options.mass_kg * kGravity);
  EXPECT_NE(ReasonOf(ReplayOf(GoodPlan(), options)), Reason::kNone);
}

TEST(HandReplayTest, TheMassIsThatOfThePlanUnlessTheOptionsStateOne) {
  plan::Plan light = GoodPlan();
  light.hand->mass_kg = 0.05;
  HandReplayOptions options;
  const double of_water = ReplayOf(GoodPlan(), options).settings.mass_kg;
  EXPECT_NE(of_water, 0.05);
  EXPECT_EQ(ReplayOf(light, options).settings.mass_kg, 0.05);
  options.density_kg_m3 = 1000;
  EXPECT_EQ(ReplayOf(light, options).settings.mass_kg, of_water);
  options.density_kg_m3.reset();
  options.mass_kg = 0.06;
  EXPECT_EQ(ReplayOf(light, options).settings.mass_kg, 0.06);
}

TEST(HandReplayTest, ActuatorsOfHalfTheForceStandAtTheirLimits) {
  HandReplayOptions options = Options();
  // First the torques are close to the limits. Then half of the force limit is missing.
  options.grasp_force_N = 1.7 * ReplayOf(GoodPlan()).settings.grasp_force_N;
  options.disturbance_ratio = 0;
  double share = 0;
  for (const StepReplay& step : ReplayOf(GoodPlan(), options).steps) {
    share = std::max(share, step.hand->torque_share);
  }
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 1);
  options.force_factor = 0.5;
  const ReplayResult result = ReplayOf(GoodPlan(), options);
  EXPECT_EQ(ReasonOf(result), Reason::kTorqueLimit) << result.steps.back().detail;
  EXPECT_THAT(result.steps.back().detail, testing::HasSubstr("is at its limit of 0.5 N"));
}

struct Control {
  const char* name;
  std::function<void(plan::Plan&)> change;
};

TEST(HandReplayTest, APlanThatIsBrokenFails) {
  const std::vector<Control> controls = {
      {"the pose is 5 mm off",
       [](plan::Plan& plan) { plan.hand->initial.pose.translation().x() += 5e-3; }},
      {"a switch is left out",
       [](plan::Plan& plan) {
         const auto at = std::ranges::find_if(plan.steps, [](const plan::Step& step) {
           return std::holds_alternative<plan::Switch>(step);
         });
         ASSERT_NE(at, plan.steps.end());
         plan.steps.erase(at);
       }},
  };
  for (const Control& control : controls) {
    plan::Plan plan = GoodPlan();
    control.change(plan);
    const ReplayResult result = ReplayOf(plan);
    EXPECT_NE(ReasonOf(result), Reason::kNone) << control.name;
    EXPECT_FALSE(result.steps.back().detail.empty()) << control.name;
  }
}

const kinematics::HandFile& FourFingers() {
  static const kinematics::HandFile file =
      kinematics::ReadHandFile(ProjectPath("models/hands/ring4.json"));
  return file;
}

/// Return a plan at one pose with a finger on each vertical face of the cube. One finger slides
/// sideways by `way` file units while the other fingers hold the cube.
plan::Plan SlidingPlan(double way) {
  gait::GaitRequest request;
  request.hand = &FourFingers().hand;
  request.solid = &Cube();
  request.scale = kScale;
  request.criteria.friction_angle = std::atan(kMu);
  request.seed = 1;
  request.robustness = gait::RobustnessLevel::kNone;  // required for plans without slides
  request.start_pose = gait::FindGait(request).gait->start.pose;
  request.goal.emplace(*request.start_pose);
  grasp::Grasp grasp;
  const double half = 0.03;
  for (const Vector3d& n :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)}) {
    const Vector3d side = Vector3d::UnitZ().cross(n);
    grasp.push_back(plan::ProjectContact(Cube(), {-half * n - 0.5 * way * side, n, {}}).contact);
  }
  request.start_grasp = grasp;
  grasp[0].p += way * Vector3d::UnitZ().cross(grasp[0].n);
  request.goal_grasp = grasp;
  const gait::GaitResult found = gait::FindGait(request);
  EXPECT_TRUE(found.gait) << found.message;
  if (!found.gait) return {};
  return plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
}

plan::Align& FirstAlign(plan::Plan& plan) {
  const auto at = std::ranges::find_if(
      plan.steps, [](const plan::Step& step) { return std::holds_alternative<plan::Align>(step); });
  return std::get<plan::Align>(*at);
}

TEST(HandReplayTest, AFingerSlidesAlongTheSurfaceWhileTheOthersHold) {
  constexpr double kWay = 0.008;
  const plan::Plan plan = SlidingPlan(kWay);
  ASSERT_EQ(plan.steps.size(), 1U);
  ASSERT_EQ(plan::StepKind(plan.steps[0]), std::string("align"));
  const ReplayResult result = ReplayHand(FourFingers(), Cube(), plan, Options());
  ASSERT_EQ(result.steps.size(), 2U);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
    EXPECT_LT(step.hand->off_m, 2e-4);
  }
  // The finger is at its target and was in contact throughout.
  const plan::FingerGrasp& end = std::get<plan::Align>(plan.steps[0]).waypoints.back();
  int slid = 0;
  for (const plan::FingerState& finger : result.steps.back().snapshot.fingers) {
    const Vector3d to = kScale * plan::FindFinger(end, finger.finger)->contact.p;
    EXPECT_LT((finger.contact_W - to).norm(), 5e-4);
    const Vector3d from = kScale * plan::FindFinger(plan.initial, finger.finger)->contact.p;
    slid += (to - from).norm() > 0.9 * kScale * kWay ? 1 : 0;
  }
  EXPECT_EQ(slid, 1);
}

TEST(HandReplayTest, ASlideThatIsBrokenFails) {
  struct BrokenSlide {
    Control control;
    const char* words;
  };
  const std::vector<BrokenSlide> controls = {
      {{"the finger does not move",
        [](plan::Plan& plan) {
          for (plan::HandPath& path : *FirstAlign(plan).motion) {
            for (plan::HandState& state : path) state = plan.hand->initial;
          }
        }},
       "from its contact"},
      {{"its goal is 5 mm away",
        [](plan::Plan& plan) {
          for (plan::FingerContact& held : FirstAlign(plan).waypoints.back()) {
            if (held.contact.p != plan::FindFinger(plan.initial, held.finger)->contact.p) {
              held.contact.p.z() += 5e-3 / kScale;
            }
          }
        }},
       "from its contact"},
      {{"two others hold",
        [](plan::Plan& plan) {
          plan::Align& align = FirstAlign(plan);
          const auto slides = [&](const plan::FingerContact& held) {
            return (held.contact.p -
                    plan::FindFinger(align.waypoints.back(), held.finger)->contact.p)
                       .norm() > 0;
          };
          const FingerIndex away = std::ranges::find_if_not(plan.initial, slides)->finger;
          for (plan::FingerGrasp* grasp : {&plan.initial, &align.waypoints[0], &align.waypoints[1]})
            std::erase_if(*grasp, [&](const auto& held) { return held.finger == away; });
        }},
       "whose force the others cannot balance"},
  };
  for (const auto& [control, words] : controls) {
    plan::Plan plan = SlidingPlan(0.008);
    control.change(plan);
    const ReplayResult result = ReplayHand(FourFingers(), Cube(), plan, Options());
    EXPECT_NE(ReasonOf(result), Reason::kNone) << control.name;
    EXPECT_THAT(result.steps.back().detail, testing::HasSubstr(words)) << control.name;
  }
}

/// Return the hand with a changed joint range, degrees.
kinematics::HandFile HandWithRange(const std::string& joint, double lower, double upper) {
  const std::string folder = ProjectPath("models/hands/");
  std::string model = ReadFile(folder + "ring5.xml");
  const std::size_t at = model.find("range=\"", model.find("name=\"" + joint + "\"")) + 7;
  model.replace(at, model.find('"', at) - at, FormatDouble(lower) + " " + FormatDouble(upper));
  const std::string to = testing::TempDir() + "narrow_hand_" + std::to_string(getpid()) + "/";
  std::filesystem::create_directories(to);
  WriteFile(to + "ring5.xml", model);
  WriteFile(to + "narrow.json", ReadFile(folder + "ring5.json"));
  return kinematics::ReadHandFile(to + "narrow.json");
}

TEST(HandReplayTest, AJointThatStopsHalfWayFails) {
  // Return the joint with the largest motion in the first in-hand motion, among fingers in contact
  // from the beginning.
  const auto& path =
      std::get<plan::Move>(*std::ranges::find_if(GoodPlan().steps, [](const plan::Step& step) {
        return std::holds_alternative<plan::Move>(step);
      })).path;
  FingerIndex finger;
  int joint = 0;
  double farthest = 0;
  for (const plan::FingerContact& held : GoodPlan().initial) {
    for (int k = 0; k < 4; ++k) {
      const double way = path.back().joints[held.finger][k] - path.front().joints[held.finger][k];
      if (std::abs(way) <= std::abs(farthest)) continue;
      finger = held.finger;
      joint = k;
      farthest = way;
    }
  }
  ASSERT_GT(std::abs(farthest), 0.1);
  const kinematics::Joint& narrowed = Hand().hand.fingers[finger].joints[joint];
  const double stop = Degrees(path.front().joints[finger][joint] + 0.3 * farthest);
  const kinematics::HandFile hand =
      farthest > 0 ? HandWithRange(narrowed.name, Degrees(narrowed.lower), stop)
                   : HandWithRange(narrowed.name, stop, Degrees(narrowed.upper));
  const ReplayResult result = ReplayHand(hand, Cube(), GoodPlan(), Options());
  EXPECT_NE(ReasonOf(result), Reason::kNone);
}

TEST(HandReplayTest, AFailureTellsWhereHandAndObjectWere) {
  plan::Plan plan = GoodPlan();
  plan.hand->initial.pose.translation().x() += 5e-2;
  const ReplayResult result = ReplayOf(plan);
  const StepReplay& last = result.steps.back();
  EXPECT_EQ(last.reason, Reason::kHandCollides);
  ASSERT_TRUE(last.fault.hand);
  EXPECT_EQ(last.fault.hand->state.joints.size(), 5U);
  EXPECT_TRUE(last.fault.hand->at);
  EXPECT_FALSE(last.fault.hand->number.empty());
}

/// Expect bitwise equal results.
void ExpectSame(const ReplayResult& a, const ReplayResult& b) {
  EXPECT_EQ(a.settings.grasp_force_N, b.settings.grasp_force_N);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(a.steps[i].index, b.steps[i].index);
    EXPECT_EQ(a.steps[i].reason, b.steps[i].reason);
    EXPECT_EQ(a.steps[i].detail, b.steps[i].detail);
    EXPECT_EQ(a.steps[i].displacement_m, b.steps[i].displacement_m);
    EXPECT_EQ(a.steps[i].drift_m, b.steps[i].drift_m);
    EXPECT_EQ(a.steps[i].slip_m, b.steps[i].slip_m);
    EXPECT_EQ(a.steps[i].snapshot.time_s, b.steps[i].snapshot.time_s);
  }
}

TEST(HandReplaysTest, GiveWhatEachPlanAloneGivesWhateverWasReplayedBefore) {
  const plan::Plan& good = GoodPlan();
  ASSERT_GE(good.steps.size(), 2U);
  plan::Plan begun = good;
  begun.steps.pop_back();
  // Plan with the same beginning, whose last motion moves the object away from the planned
  // fingertips.
  plan::Plan other = good;
  plan::Move* last_move = nullptr;
  for (plan::Step& step : other.steps) {
    if (auto* move = std::get_if<plan::Move>(&step)) last_move = move;
  }
  ASSERT_NE(last_move, nullptr);
  for (plan::HandState& state : last_move->path) state.pose.translation().x() += 5e-3;
  plan::Plan slippery = good;
  slippery.friction_angle = std::atan(0.05);
  plan::Plan heavy = good;
  heavy.hand->mass_kg = 20;
  HandReplayOptions options = Options();
  options.mass_kg.reset();
  HandReplays replays(Hand(), Cube(), options);
  std::vector<Reason> reasons;
  for (const plan::Plan* plan : std::vector<const plan::Plan*>{&begun, &good, &other, &begun,
                                                               &slippery, &good, &heavy, &good}) {
    SCOPED_TRACE(reasons.size());
    const ReplayResult alone = ReplayOf(*plan, options);
    ExpectSame(replays.Replay(*plan, {}), alone);
    reasons.push_back(ReasonOf(alone));
  }
  EXPECT_EQ(reasons[1], Reason::kNone);
  EXPECT_NE(reasons[2], Reason::kNone);
  EXPECT_NE(reasons[4], Reason::kNone);
  EXPECT_NE(reasons[6], Reason::kNone);
}

TEST(HandReplaysTest, WithoutAShakeTheyGiveTheSameToo) {
  HandReplayOptions options = Options();
  options.disturbance_ratio = 0;
  HandReplays replays(Hand(), Cube(), options);
  plan::Plan begun = GoodPlan();
  begun.steps.pop_back();
  ExpectSame(replays.Replay(begun, {}), ReplayOf(begun, options));
  ExpectSame(replays.Replay(GoodPlan(), {}), ReplayOf(GoodPlan(), options));
}

}  // namespace hand_replay_test
}  // namespace regrasp::sim
