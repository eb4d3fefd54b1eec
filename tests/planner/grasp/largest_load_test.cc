#include "planner/grasp/largest_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"

namespace regrasp::grasp {
namespace largest_load_test {

using Eigen::Vector3d;

constexpr double kFrictionAngle = Radians(20);
constexpr double kGraspForce = 50;
/// Tolerance of a load: far above the gap of the search, far below the difference of the tested
/// loads.
constexpr double kNear = 1e-7;

const object::WrenchFrame kPlane{Vector3d::Zero(), 2, 2};
const object::WrenchFrame kSpace{Vector3d::Zero(), 2, 3};

Wrench Force(double x, double y, double z) { return {{x, y, z}, Vector3d::Zero()}; }
Wrench Torque(double x, double y, double z) { return {Vector3d::Zero(), {x, y, z}}; }

/// Return two fingers on a line through the origin, at distance 1 from it.
Grasp Antipodal() { return {{{1, 0, 0}, {-1, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}}}; }

/// Return four fingers on a cube of side 2, in the middle of the faces ±x and ±y.
Grasp FourOnACube() {
  return {{{1, 0, 0}, {-1, 0, 0}},
          {{-1, 0, 0}, {1, 0, 0}},
          {{0, 1, 0}, {0, -1, 0}},
          {{0, -1, 0}, {0, 1, 0}}};
}

double Largest(const Grasp& grasp, const object::WrenchFrame& frame, const Wrench& load,
               const Wrench& direction, double friction_angle = kFrictionAngle) {
  const auto found = ComputeLargestLoad(grasp, frame, friction_angle, load, direction, kGraspForce);
  if (!found) return -1;
  EXPECT_LE(found->lower, found->upper);
  EXPECT_LE(found->upper - found->lower, kNear);
  return found->lower;
}

TEST(LargestLoadTest, APairInThePlaneBearsFrictionAcrossItsLineAndTheWholeSqueezeAlongIt) {
  const double mu = std::tan(kFrictionAngle);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(Largest(Antipodal(), kPlane, {}, Force(sign, 0, 0)), 1, kNear);
    EXPECT_NEAR(Largest(Antipodal(), kPlane, {}, Force(0, sign, 0)), mu, kNear);
    // Each finger exerts μ/2 with a moment arm of 1. Torques are divided by the radius 2.
    EXPECT_NEAR(Largest(Antipodal(), kPlane, {}, Torque(0, 0, sign)), mu / 2, kNear);
  }
}

TEST(LargestLoadTest, FourFingersOnACubeBearWhatTheirFrictionGives) {
  const double mu = std::tan(kFrictionAngle);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(Largest(FourOnACube(), kSpace, {}, Force(0, 0, sign)), mu, kNear);
    EXPECT_NEAR(Largest(FourOnACube(), kSpace, {}, Force(sign, 0, 0)), 1, kNear);
    EXPECT_NEAR(Largest(FourOnACube(), kSpace, {}, Torque(0, 0, sign)), mu / 2, kNear);
    // About x only the fingers on ±y contribute: they take the whole grasp force.
    EXPECT_NEAR(Largest(FourOnACube(), kSpace, {}, Torque(sign, 0, 0)), mu / 2, kNear);
  }
}

TEST(LargestLoadTest, AWeightTakesItsShareOneWayAndGivesItTheOther) {
  const double mu = std::tan(kFrictionAngle);
  const double share = 0.1;
  const Wrench weight = Force(0, 0, -share * kGraspForce);
  EXPECT_NEAR(Largest(FourOnACube(), kSpace, weight, Force(0, 0, -1)), mu - share, kNear);
  EXPECT_NEAR(Largest(FourOnACube(), kSpace, weight, Force(0, 0, 1)), mu + share, kNear);
}

TEST(LargestLoadTest, WhereNotEvenTheLoadIsBalancedThereIsNoAnswer) {
  const Wrench too_heavy = Force(0, 0, -0.5 * kGraspForce);
  EXPECT_FALSE(ComputeLargestLoad(FourOnACube(), kSpace, kFrictionAngle, too_heavy, Force(0, 0, -1),
                                  kGraspForce));
  Grasp one_side = FourOnACube();
  one_side.resize(1);
  EXPECT_FALSE(
      ComputeLargestLoad(one_side, kSpace, kFrictionAngle, {}, Force(0, 0, -1), kGraspForce));
}

TEST(LargestLoadTest, ForcesForTheLargestLoadExistAndForMoreDoNot) {
  std::mt19937 random(20240901);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    Grasp grasp;
    for (int f = 0; f < 4; ++f) {
      const Vector3d p = draw();
      grasp.push_back({p, (-p + 0.3 * draw()).normalized(), {}});
    }
    const double quality = ComputeQuality(grasp, kSpace, kFrictionAngle, 0.2).lower;
    if (quality == 0) continue;
    ++checked;
    Wrench direction{draw(), draw()};
    const double length = std::hypot(direction.force.norm(), direction.torque_over_radius.norm());
    direction.force /= length;
    direction.torque_over_radius /= length;
    const double largest = Largest(grasp, kSpace, {}, direction);
    EXPECT_GE(largest, quality - kNear);
    const auto balanced = [&](double share) {
      const double size = share * largest * kGraspForce;
      const Wrench load{size * direction.force, size * direction.torque_over_radius};
      return ComputeGraspForces(grasp, kSpace, kFrictionAngle, load, kGraspForce).balanced;
    };
    EXPECT_TRUE(balanced(0.999)) << i;
    EXPECT_FALSE(balanced(1.001)) << i;
    EXPECT_GE(Largest(grasp, kSpace, {}, direction, 1.2 * kFrictionAngle), largest - kNear) << i;
  }
  EXPECT_GT(checked, 5);
}

TEST(LargestLoadTest, WhatIsNoQuestionIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto ask = [](const Wrench& load, const Wrench& direction, double total) {
    return ComputeLargestLoad(Antipodal(), kPlane, kFrictionAngle, load, direction, total);
  };
  EXPECT_THROW((void)ask({}, {}, 1), std::invalid_argument);
  EXPECT_THROW((void)ask({}, Force(1, 0, 0), 0), std::invalid_argument);
  EXPECT_THROW((void)ask({}, Force(nan, 0, 0), 1), std::invalid_argument);
  EXPECT_THROW((void)ask(Force(0, nan, 0), Force(1, 0, 0), 1), std::invalid_argument);
  EXPECT_THROW((void)ComputeLargestLoad({}, kPlane, kFrictionAngle, {}, Force(1, 0, 0), 1),
               std::invalid_argument);
}

}  // namespace largest_load_test
}  // namespace regrasp::grasp
