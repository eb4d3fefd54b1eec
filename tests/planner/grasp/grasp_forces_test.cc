#include "planner/grasp/grasp_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "pyramid_program.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace grasp_forces_test {

constexpr double kTotal = 7.5;      // total normal force in these tests, N
constexpr double kRounding = 1e-9;  // N, far above the rounding error of 60 pivots

Wrench RandomLoad(RandomGrasps& random, int dimension, double size) {
  Wrench load;
  load.force = size * random.Direction(dimension);
  load.torque_over_radius =
      size * (dimension == 3 ? random.Direction(3) : Eigen::Vector3d(0, 0, random.Uniform(-1, 1)));
  return load;
}

double Unbalanced(const Grasp& grasp, const object::WrenchFrame& frame, const GraspForces& result,
                  const Wrench& load) {
  Eigen::Vector3d force = load.force;
  Eigen::Vector3d torque = load.torque_over_radius;
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    force += result.forces[i];
    torque += (grasp[i].p - frame.origin).cross(result.forces[i]) / frame.radius;
  }
  return force.norm() + torque.norm();
}

/// Return the normal component of the distance to the boundary of the cone; negative outside.
double Spare(const Contact& contact, const Eigen::Vector3d& force, double friction_angle) {
  const double normal = contact.n.dot(force);
  return normal - (force - normal * contact.n).norm() / std::tan(friction_angle);
}

double NormalSum(const Grasp& grasp, const GraspForces& result) {
  double sum = 0;
  for (std::size_t i = 0; i < grasp.size(); ++i) sum += grasp[i].n.dot(result.forces[i]);
  return sum;
}

TEST(GraspForcesTest, BalanceTheLoadInsideTheConesWithTheMarginThatTheyReport) {
  RandomGrasps random(21);
  int balanced = 0;
  int best_effort = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const int dimension = 2 + trial % 2;
    const int count = dimension + trial % 4;
    const Grasp grasp =
        trial % 3 == 0 ? random.OnBox(count, dimension) : random.OnBall(count, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(5, 50));
    const Wrench load = RandomLoad(random, dimension, trial % 4 == 0 ? 0 : 0.01 * kTotal);
    const GraspForces result = ComputeGraspForces(grasp, frame, friction_angle, load, kTotal);
    ASSERT_EQ(result.forces.size(), grasp.size());
    EXPECT_NEAR(NormalSum(grasp, result), kTotal, kRounding);
    double least = kTotal;
    for (std::size_t i = 0; i < grasp.size(); ++i) {
      least = std::min(least, Spare(grasp[i], result.forces[i], friction_angle));
    }
    EXPECT_GE(least, -kRounding);
    if (result.balanced) {
      ++balanced;
      EXPECT_LT(Unbalanced(grasp, frame, result, load), kRounding);
      EXPECT_GE(result.margin, 0);
      EXPECT_GE(least, result.margin * kTotal / count - kRounding);
    } else {
      ++best_effort;
      EXPECT_LT(result.margin, 0);
      EXPECT_GT(Unbalanced(grasp, frame, result, load), kRounding);
    }
  }
  EXPECT_GT(balanced, 300);
  EXPECT_GT(best_effort, 300);
}

TEST(GraspForcesTest, TheMarginIsTheOptimumOfTheLinearProgram) {
  RandomGrasps random(22);
  int compared = 0;
  int infeasible = 0;
  for (int trial = 0; trial < 800; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(dimension + 1 + trial % 3, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(10, 50));
    const Wrench load = RandomLoad(random, dimension, 0.02);
    const GraspForces result = ComputeGraspForces(grasp, frame, friction_angle, load, 1);
    const auto inside = PyramidMargin(grasp, frame, friction_angle, {64, false}, load);
    const auto outside = PyramidMargin(grasp, frame, friction_angle, {64, true}, load);
    constexpr double kProgramTolerance = 1e-6;
    if (inside && *inside > kProgramTolerance) {
      EXPECT_TRUE(result.balanced);
      EXPECT_GE(result.margin, *inside - kProgramTolerance);
      ASSERT_TRUE(outside);
      EXPECT_LE(result.margin, *outside + kProgramTolerance);
      ++compared;
    } else if (!outside || *outside < -kProgramTolerance) {
      EXPECT_FALSE(result.balanced);
      ++infeasible;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(infeasible, 100);
}

TEST(GraspForcesTest, TwoOpposedFingersPressEquallyAndCarryALoadByFriction) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  Wrench load;
  load.force = {0, -1, 0};
  const GraspForces result = ComputeGraspForces(grasp, UnitFrame(2), Radians(30), load, 10);
  EXPECT_TRUE(result.balanced);
  EXPECT_NEAR((result.forces[0] - Eigen::Vector3d(5, 0.5, 0)).norm(), 0, kRounding);
  EXPECT_NEAR((result.forces[1] - Eigen::Vector3d(-5, 0.5, 0)).norm(), 0, kRounding);
  EXPECT_NEAR(result.margin, 1 - 0.1 / std::tan(Radians(30)), kRounding);
}

TEST(GraspForcesTest, BestEffortUsesWhatTheConesAllow) {
  // Two fingers that slip: an offset of 1 over a width of 2 requires 26.6°. The best forces are on
  // the boundary of the cones.
  const Grasp grasp{{{-1, -0.5, 0}, {1, 0, 0}}, {{1, 0.5, 0}, {-1, 0, 0}}};
  const GraspForces result = ComputeGraspForces(grasp, UnitFrame(2), Radians(20), {}, 10);
  EXPECT_FALSE(result.balanced);
  const GraspForces enough = ComputeGraspForces(grasp, UnitFrame(2), Radians(27), {}, 10);
  EXPECT_TRUE(enough.balanced);
  // Forces cancel; the remaining torque is (offset − width tan θ) · 5 N over R = 1.
  EXPECT_NEAR(Unbalanced(grasp, UnitFrame(2), result, {}), 5 - 10 * std::tan(Radians(20)), 1e-6);
}

/// The average of forces for two sums of normal forces is valid for the average sum. Hence the
/// least unbalanced part is a convex function of the sum.
TEST(GraspForcesTest, WhatTheBestEffortLeavesUnbalancedIsConvexInTheSumOfNormalForces) {
  // of the least unbalanced parts, whose relative precision is 1e-6
  constexpr double kNearest = 1e-5;
  RandomGrasps random(77);
  int best_efforts = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(2 + trial % 4, dimension);
    const Wrench load = RandomLoad(random, dimension, 1);
    const double friction_angle = Radians(random.Uniform(5, 40));
    const auto left = [&](double total) {
      const GraspForces found =
          ComputeGraspForces(grasp, UnitFrame(dimension), friction_angle, load, total);
      return found.balanced ? 0 : -found.margin * total;
    };
    const double few = random.Uniform(0.1, 4);
    const double many = random.Uniform(0.1, 4);
    const double middle = left((few + many) / 2);
    EXPECT_LE(middle, (left(few) + left(many)) / 2 * (1 + kNearest)) << trial;
    best_efforts += static_cast<int>(middle > 0);
  }
  EXPECT_GT(best_efforts, 100);
}

TEST(GraspForcesTest, BadArgumentsThrow) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_NO_THROW((void)ComputeGraspForces(grasp, UnitFrame(2), 0.3, {}, 1));
  EXPECT_THROW((void)ComputeGraspForces(grasp, UnitFrame(2), 0.3, {}, 0), std::invalid_argument);
  EXPECT_THROW((void)ComputeGraspForces(grasp, UnitFrame(2), 2.0, {}, 1), std::invalid_argument);
  Wrench load;
  load.force.x() = std::nan("");
  EXPECT_THROW((void)ComputeGraspForces(grasp, UnitFrame(2), 0.3, load, 1), std::invalid_argument);
}

}  // namespace grasp_forces_test

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
