#include "planner/grasp/required_friction_angle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
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
}  // namespace regrasp::grasp
