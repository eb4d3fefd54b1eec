#include "sim/scene/scaling.h"

#include <gtest/gtest.h>

#include "planner/grasp/quality.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace scaling_test {

/// Return a rod along x, 1 m long, with a square section.
object::Polyhedron MakeRod(double width) {
  const double a = 0.5, b = width / 2;
  const object::PolygonSoup soup{
      {{-a, -b, -b},
       {a, -b, -b},
       {a, b, -b},
       {-a, b, -b},
       {-a, -b, b},
       {a, -b, b},
       {a, b, b},
       {-a, b, b}},
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  return object::Polyhedron::FromSoup(soup, "rod");
}

/// Return a plan with two pairs of opposite fingers across the rod, `apart` m from each other.
plan::Plan HoldRod(const object::Polyhedron& rod, double width, double apart,
                   double friction_angle_deg) {
  const double b = width / 2, x = apart / 2, off = 0.3 * b;
  return MakePlan({{FingerIndex(0), ContactAt(rod, {x, off, b}, {0, 0, -1})},
                   {FingerIndex(1), ContactAt(rod, {x, off, -b}, {0, 0, 1})},
                   {FingerIndex(2), ContactAt(rod, {-x, b, off}, {0, -1, 0})},
                   {FingerIndex(3), ContactAt(rod, {-x, -b, off}, {0, 1, 0})}},
                  friction_angle_deg);
}

StepReplay ShakeRod(const object::Polyhedron& rod, const plan::Plan& plan,
                    double disturbance_ratio) {
  ReplayOptions options;
  options.disturbance_ratio = disturbance_ratio;
  return ReplayPlan(rod, plan, options).steps.at(0);
}

bool FailsForItsOwnReason(const StepReplay& hold) {
  return hold.reason == plan::Reason::kObjectMoved || hold.reason == plan::Reason::kSlipped ||
         hold.reason == plan::Reason::kContactLost;
}

TEST(Needle, IsHeldByAGraspWhoseQualityExceedsTheShakeAndByNoOther) {
  for (const double width : {1e-1, 1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(width);
    const object::Polyhedron rod = MakeRod(width);
    const plan::Plan plan = HoldRod(rod, width, 0.8, 35);
    const double quality = grasp::ComputeQuality(plan::ContactsOf(plan.initial), rod.wrench_frame(),
                                                 plan.friction_angle)
                               .lower;
    // Torques are divided by half the length, but friction has only half the width as moment arm.
    EXPECT_LT(quality, width);
    EXPECT_GT(quality, width / 2);
    for (const double share : {0.6, 0.9}) {
      const StepReplay good = ShakeRod(rod, plan, share * quality);
      EXPECT_EQ(good.reason, plan::Reason::kNone) << share << ": " << good.detail;
    }
    const StepReplay weak = ShakeRod(rod, plan, 1.5 * quality);
    EXPECT_TRUE(FailsForItsOwnReason(weak)) << plan::ReasonName(weak.reason) << " " << weak.detail;
    const StepReplay much = ShakeRod(rod, plan, 10 * quality);
    EXPECT_TRUE(FailsForItsOwnReason(much)) << plan::ReasonName(much.reason) << " " << much.detail;
  }
}

TEST(Needle, IsLostWithoutForceClosureForItsOwnReason) {
  for (const double width : {1e-3, 1e-4}) {
    SCOPED_TRACE(width);
    const object::Polyhedron rod = MakeRod(width);
    plan::Plan plan = HoldRod(rod, width, 0.8, 35);
    // With both pairs at one place, only friction across the rod's width resists a rotation across
    // the rod.
    for (plan::FingerContact& held : plan.initial) held.contact.p.x() = 0.1;
    const StepReplay hold = ShakeRod(rod, plan, 1e-3);
    EXPECT_TRUE(FailsForItsOwnReason(hold)) << plan::ReasonName(hold.reason) << " " << hold.detail;
  }
}

TEST(Needle, IsSimulatedInSmallerStepsAndOtherBodiesAreNot) {
  const CubeCase cube;
  const auto steps = [](const ReplaySettings& s) { return s.characteristic_time_s / s.timestep_s; };
  const double usual = steps(DeriveSettings(cube.object, 1, 0.3, 1, {}));
  EXPECT_NEAR(usual, 50, 1e-9);
  EXPECT_NEAR(steps(DeriveSettings(MakeRod(0.1), 1, 0.3, 1, {})), usual, 1e-9);
  const double thin = steps(DeriveSettings(MakeRod(1e-3), 1, 0.3, 1, {}));
  EXPECT_GT(thin, 3 * usual);
  EXPECT_LT(thin, 20 * usual);
}

TEST(EngineUnits, MakeEveryBodyLookAlike) {
  const CubeCase cube;
  for (const double scale : {1e-4, 1.0, 1e3}) {
    const ReplaySettings s = DeriveSettings(cube.object, scale, 0.3, scale, {});
    const EngineUnits units = UnitsOf(s);
    EXPECT_NEAR(s.diameter_m / units.length_m, kEngineDiameter, 1e-9);
    EXPECT_NEAR(s.mass_kg / units.mass_kg, 1, 1e-12);
    // F T² / (M D) = 1.
    EXPECT_NEAR(s.grasp_force_N / units.force_N() * kEngineTime * kEngineTime / kEngineDiameter, 1,
                1e-9);
  }
}

}  // namespace scaling_test
}  // namespace regrasp::sim
