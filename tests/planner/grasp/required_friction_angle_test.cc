#include "planner/grasp/required_friction_angle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace required_friction_angle_test {

/// Tolerance, well above the differences of bounds next to an angle that is too close to call.
constexpr double kClose = 1e-6;

TEST(RequiredFrictionAngleTest, TwoOppositeFingersNeedTheAngleOfTheirOffset) {
  for (const double offset : {0.0, 0.1, 0.5, 1.0, 3.0}) {
    const double width = 2;
    const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, offset, 0}, {-1, 0, 0}}};
    const auto required = ComputeRequiredFrictionAngle(grasp, UnitFrame(2));
    ASSERT_TRUE(required);
    EXPECT_LE(required->lower, std::atan(offset / width) + 1e-12);
    EXPECT_GE(required->upper, std::atan(offset / width) - 1e-12);
    EXPECT_LT(required->upper - required->lower, kClose);
  }
}

TEST(RequiredFrictionAngleTest, ARegularTetrahedronNeedsNone) {
  Grasp grasp;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                                        Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
    grasp.push_back({corner.normalized(), -corner.normalized()});
  }
  const auto required = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
  ASSERT_TRUE(required);
  EXPECT_LT(required->upper, kClose);
}

TEST(RequiredFrictionAngleTest, ThreeBentFingersNeedTheirBend) {
  // Three fingers on a circle with normals tilted upwards: they balance only if the cones extend
  // downwards.
  for (const double bend : {3.0, 20.0, 50.0}) {
    Grasp grasp;
    for (int i = 0; i < 3; ++i) {
      const double angle = Radians(120.0 * i);
      const Eigen::Vector3d p(std::cos(angle), std::sin(angle), 0);
      grasp.push_back(
          {p, (-std::cos(Radians(bend)) * p + std::sin(Radians(bend)) * Eigen::Vector3d::UnitZ())});
    }
    const auto required = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
    ASSERT_TRUE(required);
    EXPECT_NEAR(required->upper, Radians(bend), kClose);
    EXPECT_NEAR(required->lower, Radians(bend), kClose);
  }
}

TEST(RequiredFrictionAngleTest, HoldsAtTheUpperBoundAndAboveAndNotAtTheLowerAndBelow) {
  RandomGrasps random(11);
  int found = 0;
  double widest = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = trial % 3 == 0 ? random.OnBox(2 + trial % 4, dimension)
                                       : random.OnBall(2 + trial % 4, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const auto required = ComputeRequiredFrictionAngle(grasp, frame);
    if (!required) {
      EXPECT_FALSE(IsForceClosure(grasp, frame, Radians(89.99)));
      continue;
    }
    ++found;
    widest = std::max(widest, required->upper - required->lower);
    const double above = random.Uniform(required->upper, Radians(89.99));
    EXPECT_TRUE(IsForceClosure(grasp, frame, required->upper));
    EXPECT_TRUE(IsForceClosure(grasp, frame, above));
    if (required->lower <= 0) continue;
    EXPECT_EQ(TestForceClosure(grasp, frame, required->lower).decision, Decision::kNo);
    const double below = random.Uniform(0, required->lower);
    if (below > 0) {
      EXPECT_EQ(TestForceClosure(grasp, frame, below).decision, Decision::kNo);
    }
  }
  EXPECT_GT(found, 300);
  EXPECT_LT(widest, kClose);
}

TEST(RequiredFrictionAngleTest, BetweenKnownBoundsItIsTheSame) {
  RandomGrasps random(13);
  const double tolerance = 1e-7;
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(3 + trial % 3, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const auto required = ComputeRequiredFrictionAngle(grasp, frame);
    if (!required || required->lower <= 0) continue;
    ++found;
    const RequiredFrictionAngle known{random.Uniform(0, required->lower),
                                      random.Uniform(required->upper, Radians(89))};
    const RequiredFrictionAngle narrowed =
        NarrowRequiredFrictionAngle(grasp, frame, known, tolerance);
    EXPECT_NEAR(narrowed.lower, required->lower, kClose);
    EXPECT_NEAR(narrowed.upper, required->upper, kClose);
    // If the grasp requires less than the known angle, that angle is not needed.
    const RequiredFrictionAngle above{required->upper + tolerance, Radians(89)};
    EXPECT_LE(NarrowRequiredFrictionAngle(grasp, frame, above, tolerance).upper,
              above.lower + tolerance);
  }
  EXPECT_GT(found, 80);
}

TEST(RequiredFrictionAngleTest, MoreContactsNeverNeedMore) {
  RandomGrasps random(12);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Grasp grasp = random.OnBall(4, 3);
    const auto before = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
    grasp.push_back(random.OnBall(1, 3).front());
    const auto after = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
    if (!before) continue;
    ASSERT_TRUE(after);
    EXPECT_LE(after->lower, before->upper);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(RequiredFrictionAngleTest, NoneWhereNoFrictionIsEnough) {
  EXPECT_FALSE(ComputeRequiredFrictionAngle(Grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}},
                                            UnitFrame(3)));
  EXPECT_FALSE(ComputeRequiredFrictionAngle(Grasp{{{1, 0, 0}, {-1, 0, 0}}}, UnitFrame(2)));
  EXPECT_FALSE(ComputeRequiredFrictionAngle(
      Grasp{{{1, 0, 0}, {-1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}},
      UnitFrame(3)));
}

TEST(RequiredFrictionAngleTest, BadArgumentsThrow) {
  EXPECT_THROW((void)ComputeRequiredFrictionAngle({}, UnitFrame(3)), std::invalid_argument);
  const Grasp grasp{{{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_THROW((void)ComputeRequiredFrictionAngle(grasp, UnitFrame(3), 0), std::invalid_argument);
  EXPECT_THROW((void)NarrowRequiredFrictionAngle(grasp, UnitFrame(3), {0, 1}, 0),
               std::invalid_argument);
}

}  // namespace required_friction_angle_test

namespace finger_friction_test {

using Eigen::Vector3d;

const object::WrenchFrame kPlane = {{0, 0, 0}, 1, 2};

Vector3d Direction(double degrees) {
  return {std::cos(Radians(degrees)), std::sin(Radians(degrees)), 0};
}

TEST(FingerFrictionTest, EachOfTwoFingersNeedsTheAngleToTheLineBetweenThem) {
  const Grasp grasp = {{{0, 0, 0}, Direction(12)}, {{1, 0, 0}, Direction(180 - 4)}};
  const auto fingers = MeasureFingerFriction(grasp, kPlane, Radians(20));
  ASSERT_EQ(fingers.size(), 2u);
  EXPECT_NEAR(Degrees(fingers[0].required), 12, 1e-6);
  EXPECT_NEAR(Degrees(fingers[1].required), 4, 1e-6);
  EXPECT_TRUE(fingers[0].needed && fingers[1].needed);
  EXPECT_EQ(WeakestFinger(fingers), 0);
}

TEST(FingerFrictionTest, AFingerThatIsNotNeededNeedsNoFriction) {
  const Grasp grasp = {
      {{-1, 0, 0}, Direction(3)}, {{1, 0, 0}, Direction(180)}, {{0.2, -1, 0}, Direction(90)}};
  const auto fingers = MeasureFingerFriction(grasp, kPlane, Radians(20));
  ASSERT_EQ(fingers.size(), 3u);
  EXPECT_FALSE(fingers[2].needed);
  EXPECT_EQ(fingers[2].required, 0);
  EXPECT_TRUE(fingers[0].needed && fingers[1].needed);
  EXPECT_NE(WeakestFinger(fingers), 2);
}

TEST(FingerFrictionTest, WhereNoFingerIsNeededTheOneWhoseLossCostsMostIsTheWeakest) {
  // Two pairs, of which the second has the larger required friction. Without a finger of the first
  // pair, the second must hold.
  const Grasp grasp = {{{-1, 0, 0}, Direction(3)},
                       {{1, 0, 0}, Direction(180)},
                       {{0, -1, 0}, Direction(90 + 9)},
                       {{0, 1, 0}, Direction(270)}};
  const auto fingers = MeasureFingerFriction(grasp, kPlane, Radians(20));
  ASSERT_EQ(fingers.size(), 4u);
  for (const FingerFriction& finger : fingers) EXPECT_FALSE(finger.needed);
  ASSERT_TRUE(fingers[0].without && fingers[2].without);
  EXPECT_GT(*fingers[0].without, *fingers[2].without);
  EXPECT_LT(WeakestFinger(fingers), 2);
}

TEST(FingerFrictionTest, AGraspThatIsNotForceClosureHasNoWeakestFinger) {
  const Grasp grasp = {{{0, 0, 0}, Direction(12)}, {{1, 0, 0}, Direction(180 - 4)}};
  EXPECT_TRUE(MeasureFingerFriction(grasp, kPlane, Radians(11)).empty());
  EXPECT_EQ(WeakestFinger({}), -1);
}

TEST(FingerFrictionTest, TheFirstOfEqualFingersIsTheWeakest) {
  const Grasp grasp = {{{0, 0, 0}, Direction(5)}, {{1, 0, 0}, Direction(180 + 5)}};
  EXPECT_EQ(WeakestFinger(MeasureFingerFriction(grasp, kPlane, Radians(20))), 0);
}

TEST(FingerFrictionTest, RandomGraspsInSpaceObeyTheLaws) {
  RandomStream random(5, RandomUse::kStart);
  const object::WrenchFrame frame = {{0, 0, 0}, 1, 3};
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1, -2, 3) * Eigen::AngleAxisd(1.1, Vector3d(1, 2, 2).normalized());
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    Grasp grasp, moved;
    for (int finger = 0; finger < 4; ++finger) {
      const auto draw = [&] { return 2 * random.Uniform() - 1; };
      const Vector3d n = Vector3d(draw(), draw(), draw()).normalized();
      grasp.push_back({-n, n});
      moved.push_back({motion * Vector3d(-n), motion.linear() * n});
    }
    const auto required = ComputeRequiredFrictionAngle(grasp, frame);
    if (!required || required->upper > Radians(60)) continue;
    ++checked;
    const double angle = required->upper + Radians(2);
    const auto fingers = MeasureFingerFriction(grasp, frame, angle);
    const auto wider = MeasureFingerFriction(grasp, frame, angle + Radians(2));
    const auto turned = MeasureFingerFriction(moved, frame, angle);
    ASSERT_EQ(fingers.size(), 4u);
    for (int finger = 0; finger < 4; ++finger) {
      EXPECT_LE(fingers[finger].required, angle);
      EXPECT_LE(wider[finger].required, fingers[finger].required + 1e-8);
      EXPECT_NEAR(turned[finger].required, fingers[finger].required, 1e-6);
    }
    // At the required friction angle one of the fingers has no friction margin.
    const auto critical = MeasureFingerFriction(grasp, frame, required->upper);
    ASSERT_EQ(critical.size(), 4u);
    EXPECT_NEAR(critical[WeakestFinger(critical)].required, required->upper, 1e-5);
  }
  EXPECT_GT(checked, 10);
}

/// Return a random grasp, or one whose fingers are equal in pairs.
Grasp SomeGrasp(RandomGrasps& random, int trial, int dimension) {
  const int count = 2 + trial % 4;
  if (trial % 3 != 0) return random.OnBall(count, dimension);
  Grasp grasp = random.OnBall(count, dimension, 0);
  const std::size_t drawn = grasp.size();
  for (std::size_t i = 0; i < drawn; ++i) grasp.push_back({-grasp[i].p, -grasp[i].n});
  return grasp;
}

TEST(FingerFrictionTest, TheWeakestFingerAloneIsThatOfAllToTheLastBit) {
  RandomGrasps random(6);
  int found = 0, not_needed = 0, none = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = SomeGrasp(random, trial, dimension);
    const double friction_angle = random.Uniform(Radians(10), Radians(60));
    const auto all = MeasureFingerFriction(grasp, UnitFrame(dimension), friction_angle);
    const auto alone = FindWeakestFinger(grasp, UnitFrame(dimension), friction_angle);
    ASSERT_EQ(all.empty(), !alone.has_value()) << trial;
    if (!alone) {
      ++none;
      continue;
    }
    const FingerFriction& expected = all[alone->finger];
    EXPECT_EQ(alone->finger, WeakestFinger(all)) << trial;
    EXPECT_EQ(alone->friction.required, expected.required) << trial;
    EXPECT_EQ(alone->friction.needed, expected.needed) << trial;
    EXPECT_EQ(alone->friction.without, expected.without) << trial;
    ++found;
    not_needed += expected.needed ? 0 : 1;
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(not_needed, 10);
  EXPECT_GT(none, 20);
}

}  // namespace finger_friction_test
}  // namespace regrasp::grasp
