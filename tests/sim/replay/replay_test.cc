#include "sim/replay/replay.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "planner/base/error.h"
#include "tests/sim/replay/replay_expectations.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace replay_test {

plan::Plan FourSwitches(const CubeCase& cube) {
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}},
                plan::Switch{{cube.At(2, 0.002, 0.003, -0.03)}, {FingerIndex(3)}},
                plan::Switch{{cube.At(3, 0.03, -0.006, 0.008)}, {FingerIndex(0)}},
                plan::Switch{{cube.At(0, -0.03, -0.008, 0.006)}, {FingerIndex(1)}}};
  return plan;
}

TEST(ReplayHold, HoldsAGoodGrasp) {
  const CubeCase cube;
  ExpectGood(ReplayPlan(cube.object, MakePlan(cube.Start(), 25), {}), 1);
}

TEST(ReplayHold, LosesTheSameGraspBelowItsRequiredFriction) {
  const CubeCase cube;
  // The grasp requires 5.3°.
  const ReplayResult result = ReplayPlan(cube.object, MakePlan(cube.Start(), 4), {});
  ASSERT_EQ(result.steps.size(), 1u);
  EXPECT_TRUE(LosesObject(result.steps[0].reason)) << plan::ReasonName(result.steps[0].reason);
  EXPECT_FALSE(result.steps[0].detail.empty());
}

TEST(ReplayHold, FrictionIsThatOfThePlan) {
  const CubeCase cube;
  const ReplayResult result = ReplayPlan(cube.object, MakePlan(cube.Start(), 4), {});
  EXPECT_TRUE(LosesObject(result.steps.at(0).reason));
  EXPECT_NEAR(result.settings.mu, std::tan(Radians(4)), 1e-12);
}

TEST(ReplayHold, DropsTheObjectWhereGravityIsMoreThanTheSqueezeBears) {
  const CubeCase cube;
  ReplayOptions options;
  options.grasp_force_N = 0.5;  // for a weight of 2.1 N, at friction 0.47
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  EXPECT_TRUE(LosesObject(ReplayPlan(cube.object, plan, options).steps.at(0).reason));
  options.gravity = false;
  EXPECT_EQ(ReplayPlan(cube.object, plan, options).steps.at(0).reason, plan::Reason::kNone);
}

TEST(ReplayHold, FailsUnderAShakeLargerThanTheQuality) {
  const CubeCase cube;
  ReplayOptions options;
  options.disturbance_ratio = 0.6;
  EXPECT_TRUE(
      LosesObject(ReplayPlan(cube.object, MakePlan(cube.Start(), 25), options).steps.at(0).reason));
}

TEST(ReplayFault, OfASlipIsWhereTheFingerWasAndCameToUnderThePush) {
  const CubeCase cube;
  ReplayOptions options;
  options.tolerance = 1e-12;  // fingertips creep, and the first reason counts
  const StepReplay step = ReplayPlan(cube.object, MakePlan(cube.Start(), 25), options).steps.at(0);
  ASSERT_EQ(step.reason, plan::Reason::kSlipped);
  ASSERT_EQ(step.fault.fingers.size(), 1u);
  EXPECT_NE(step.detail.find("finger " + std::to_string(step.fault.fingers[0])), std::string::npos);
  const Eigen::Vector3d& from = step.fault.expected.at(0).p;
  EXPECT_LT((from - cube.Start()[step.fault.fingers[0]].contact.p).norm(), 1e-3);
  EXPECT_GT((step.fault.found->p - from).norm(), 0);
  EXPECT_TRUE(step.fault.X_WO_before.has_value());
}

TEST(ReplayFault, OfAnObjectThatMovesHasThePushAndWhereItWas) {
  const CubeCase cube;
  ReplayOptions options;
  options.disturbance_ratio = 0.6;
  const StepReplay step = ReplayPlan(cube.object, MakePlan(cube.Start(), 25), options).steps.at(0);
  ASSERT_TRUE(LosesObject(step.reason));
  ASSERT_TRUE(step.fault.disturbance.has_value()) << step.detail;
  const double size =
      step.fault.disturbance->force_N.norm() + step.fault.disturbance->torque_Nm.norm();
  EXPECT_GT(size, 0);
  EXPECT_TRUE(step.fault.X_WO_before.has_value());
  // The snapshot is that of the failure, not that of the static grasp before it.
  EXPECT_GT((step.snapshot.X_WO.translation()).norm(), step.displacement_m / 2);
}

TEST(ReplayFault, OfAStepThatPassesIsEmpty) {
  const CubeCase cube;
  const StepReplay step = ReplayPlan(cube.object, MakePlan(cube.Start(), 25), {}).steps.at(0);
  ASSERT_EQ(step.reason, plan::Reason::kNone);
  EXPECT_TRUE(step.fault.fingers.empty());
  EXPECT_FALSE(step.fault.disturbance || step.fault.found || step.fault.X_WO_before);
}

TEST(ReplayHold, AGraspWithoutFingersFails) {
  const CubeCase cube;
  EXPECT_NE(ReplayPlan(cube.object, MakePlan({}, 25), {}).steps.at(0).reason, plan::Reason::kNone);
}

TEST(ReplaySwitch, ReplaysFourSwitchesOnTheCube) {
  const CubeCase cube;
  const ReplayResult result = ReplayPlan(cube.object, FourSwitches(cube), {});
  ExpectGood(result, 5);
  std::cout << "largest drift over D: " << result.steps.back().drift_m / result.settings.diameter_m
            << "\n";
}

TEST(ReplaySwitch, PlacesAndReleasesSeveralFingersInOneStep) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25, 6);
  plan.steps = {plan::Switch{{cube.At(4, 0.001, 0.002, 0.03), cube.At(5, -0.002, 0.001, -0.03)},
                             {FingerIndex(2), FingerIndex(3)}},
                plan::Switch{{cube.At(2, 0.003, 0.03, 0.004)}, {}},
                plan::Switch{{}, {FingerIndex(2)}}};
  ExpectGood(ReplayPlan(cube.object, plan, {}), 4);
}

TEST(ReplaySwitch, AFingerThatIsReleasedIsOffTheSurface) {
  const CubeCase cube;
  const plan::Plan plan = FourSwitches(cube);
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  int released = 0;
  for (std::size_t i = 1; i < result.steps.size(); ++i) {
    const plan::Snapshot& shown = result.steps[i].snapshot;
    for (const plan::FingerState& state : shown.fingers) {
      if (state.role != plan::FingerRole::kReleased) continue;
      ++released;
      EXPECT_EQ(state.finger, std::get<plan::Switch>(plan.steps[i - 1]).release[0]);
      const Eigen::Vector3d tip = shown.X_WO.inverse() * state.tip_W;
      EXPECT_GT(tip.cwiseAbs().maxCoeff(), 0.03 + 1.5 * shown.fingertip_radius_m);
      EXPECT_TRUE(state.force_W.isZero());
    }
  }
  EXPECT_EQ(released, 4);
}

TEST(ReplaySwitch, FailsWhereACarryingFingerLeaves) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  // Fingers 0 and 2 remain, on two neighbouring faces.
  plan.steps = {plan::Switch{{}, {FingerIndex(1), FingerIndex(3)}},
                plan::Switch{{cube.At(1, -0.03, 0.002, -0.004)}, {}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  ASSERT_EQ(result.steps.size(), 2u);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone);
  EXPECT_TRUE(LosesObject(result.steps[1].reason)) << plan::ReasonName(result.steps[1].reason);
}

TEST(ReplayPlanTest, ReplaysAsManyEntriesAsAsked) {
  const CubeCase cube;
  int calls = 0;
  ReplayObserver observer;
  observer.on_progress = [&](int done, int total) {
    EXPECT_EQ(done, ++calls);
    EXPECT_EQ(total, 2);
  };
  EXPECT_EQ(ReplayPlan(cube.object, FourSwitches(cube), {}, observer, 2).steps.size(), 2u);
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(ReplayPlan(cube.object, FourSwitches(cube), {}, {}, 0).steps.empty());
}

TEST(ReplayPlanTest, EveryStepIsMeasuredForItself) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25, 6);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}},
                plan::Switch{{cube.At(5, 0.002, 0.003, -0.03)}, {FingerIndex(3)}}};
  const ReplayResult result = ReplayPlan(cube.object, plan, {});
  ASSERT_EQ(result.steps.size(), 3u);
  plan::FingerGrasp before = plan.initial;
  for (std::size_t i = 1; i < result.steps.size(); ++i) {
    const plan::FingerGrasp& place = std::get<plan::Switch>(plan.steps[i - 1]).place;
    // Fingers that hold before the step, and fingers that it places; not those released by an
    // earlier step.
    std::set<int> held, measured;
    for (const plan::FingerContact& contact : before) held.insert(contact.finger);
    for (const plan::FingerContact& contact : place) held.insert(contact.finger);
    for (const auto& [finger, margin] : result.steps[i].motion_margins) measured.insert(finger);
    EXPECT_EQ(measured, held) << i;
    before = plan::GraspAfter(before, plan.steps[i - 1]);
  }
}

TEST(ReplayPlanTest, TheSamePlanGivesTheSameBits) {
  const CubeCase cube;
  ExpectSameBitsTwice(cube.object, FourSwitches(cube));
}

TEST(ReplayPlanTest, SnapshotsShowTheContactsInTheObjectsFrame) {
  const CubeCase cube;
  const plan::Plan plan = FourSwitches(cube);
  ExpectTouchesAsPlanned(cube.object, plan, ReplayPlan(cube.object, plan, {}));
}

TEST(ReplayPlanTest, RefusesAContactOnNoFace) {
  const CubeCase cube;
  plan::FingerGrasp grasp = cube.Start();
  grasp[0].contact.face = {};
  EXPECT_THROW((void)ReplayPlan(cube.object, MakePlan(grasp, 25), {}), InputError);
}

TEST(ReplayPlanTest, LeavesNoLogFileBehindAndGivesTheEnginesHooksBack) {
  const CubeCase cube;
  (void)ReplayPlan(cube.object, MakePlan(cube.Start(), 4), {});
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
  EXPECT_EQ(mju_user_error, nullptr);
  EXPECT_EQ(mju_user_warning, nullptr);
}

/// Replay the cube's four switches at another size and mass.
ReplayResult ReplayScaled(double scale, double density) {
  const CubeCase cube;
  plan::Plan plan = FourSwitches(cube);
  plan.scale = scale;
  ReplayOptions options;
  options.density_kg_m3 = density;
  return ReplayPlan(cube.object, plan, options);
}

TEST(ReplayScale, ReplaysBodiesFromGramsToTonnes) {
  // Edges of 6 mm, 6 cm and 60 cm; 0.2 g, 22 g, 216 g and 1.7 t.
  for (const auto& [scale, density] :
       {std::pair{0.1, 1000.0}, {1.0, 100.0}, {1.0, 1000.0}, {10.0, 8000.0}}) {
    SCOPED_TRACE(scale);
    ExpectGood(ReplayScaled(scale, density), 5);
  }
}

TEST(ReplayScale, MovesTheSameAtEverySizeAndMass) {
  const ReplayResult one = ReplayScaled(1, 1000);
  // Sizes from 60 nm to 60 km.
  for (const double scale : {1e-6, 1e-3, 1e6}) {
    for (const double density : {1.0, 1e4}) {
      SCOPED_TRACE(scale);
      const ReplayResult other = ReplayScaled(scale, density);
      ExpectGood(other, 5);
      const double ratio = other.settings.diameter_m / one.settings.diameter_m;
      EXPECT_NEAR(ratio, scale, 1e-9 * scale);
      for (std::size_t i = 0; i < one.steps.size() && i < other.steps.size(); ++i) {
        EXPECT_NEAR(other.steps[i].moved_m / ratio, one.steps[i].moved_m,
                    1e-2 * one.steps[i].moved_m);
      }
    }
  }
  // Negative control: with too little friction the grasp also fails at every size.
  const CubeCase cube;
  for (const double scale : {1e-6, 1e6}) {
    plan::Plan plan = MakePlan(cube.Start(), 4);
    plan.scale = scale;
    EXPECT_TRUE(LosesObject(ReplayPlan(cube.object, plan, {}).steps.at(0).reason));
  }
}

TEST(ReplayScale, MillimetresWithAScaleAreMetres) {
  const CubeCase cube;
  plan::Plan metres = FourSwitches(cube);
  const auto& body = dynamic_cast<const object::Polyhedron&>(cube.object);
  object::PolygonSoup soup{body.vertices(), {}};
  for (Eigen::Vector3d& v : soup.vertices) v *= 1000;
  for (const auto& [a, b, c] : body.triangles()) soup.facets.push_back({a, b, c});
  const object::Polyhedron big = object::Polyhedron::FromSoup(soup, "cube in millimetres");
  const auto enlarge = [&](plan::FingerGrasp& grasp) {
    for (plan::FingerContact& held : grasp) {
      held.contact = ContactAt(big, 1000 * held.contact.p, held.contact.n);
    }
  };
  plan::Plan millimetres = metres;
  millimetres.scale = 1e-3;
  enlarge(millimetres.initial);
  for (plan::Step& step : millimetres.steps) enlarge(std::get<plan::Switch>(step).place);
  const ReplayResult a = ReplayPlan(cube.object, metres, {});
  const ReplayResult b = ReplayPlan(big, millimetres, {});
  ExpectGood(b, 5);
  EXPECT_NEAR(a.settings.grasp_force_N, b.settings.grasp_force_N, 1e-9 * a.settings.grasp_force_N);
  EXPECT_NEAR(a.settings.timestep_s, b.settings.timestep_s, 1e-9 * a.settings.timestep_s);
}

TEST(ReplayScale, RefusesSizesThatCannotBeSimulated) {
  const CubeCase cube;
  plan::Plan plan = FourSwitches(cube);
  for (const double scale : {1e-9, 1e9}) {
    plan.scale = scale;
    EXPECT_THROW((void)ReplayPlan(cube.object, plan, {}), InputError);
  }
}

}  // namespace replay_test
}  // namespace regrasp::sim
