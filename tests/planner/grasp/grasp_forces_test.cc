#include "planner/grasp/grasp_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
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
}  // namespace regrasp::grasp
