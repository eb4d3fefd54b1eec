#include "planner/grasp/load_resistance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace load_resistance_test {

using Eigen::Vector3d;

constexpr double kFriction = Radians(35);
constexpr double kWeight = 1.5;  // N
const object::WrenchFrame kFrame{Vector3d::Zero(), 2, 3};

/// Contacts below the object on a circle, with vertical normals.
Grasp Table(double radius, double height, int count = 3) {
  Grasp grasp;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    grasp.push_back(
        {{radius * std::cos(angle), radius * std::sin(angle), -height}, Vector3d::UnitZ(), {}});
  }
  return grasp;
}

Wrench Weight() { return {-kWeight * Vector3d::UnitZ(), Vector3d::Zero()}; }

double Resistance(const Grasp& grasp, double most, double friction = kFriction,
                  const object::WrenchFrame& frame = kFrame) {
  return BoundLoadResistance(grasp, frame, friction, Weight(), most).lower;
}

/// Three feet on the table, with friction that resists in all other directions: a torque about a
/// horizontal axis lifts a foot off when the weight times the inscribed radius is exceeded.
TEST(LoadResistanceTest, AnObjectOnThreeFeetTiltsAtTheInscribedRadius) {
  const double circumscribed = 0.4;
  const double inscribed = circumscribed / 2;
  const LoadResistance bounds = BoundLoadResistance(Table(circumscribed, 0), kFrame, Radians(60),
                                                    Weight(), 100 * kWeight, 1e-3);
  // A disturbance tilts with its torque and lifts with its force: it is nearest to the boundary
  // along the unit vector of (inscribed / R, 1).
  const double arm = inscribed / kFrame.radius;
  const double expected = kWeight * arm / std::hypot(1, arm);
  EXPECT_LE(bounds.lower, expected * (1 + 1e-9));
  EXPECT_GE(bounds.upper, expected * (1 - 1e-9));
  EXPECT_NEAR(bounds.lower, expected, 2e-3 * expected);
}

TEST(LoadResistanceTest, ThereIsNoResistanceIfTheCentroidIsOutsideTheFeet) {
  object::WrenchFrame frame = kFrame;
  frame.origin = {0.5, 0, 0};
  EXPECT_GT(Resistance(Table(0.9, 0.1), 9 * kWeight), 0);
  EXPECT_EQ(Resistance(Table(0.4, 0.1), 9 * kWeight, kFriction, frame), 0);
}

TEST(LoadResistanceTest, FingersAboveTheObjectDoNotCarryIt) {
  Grasp above = Table(0.9, -0.1);
  for (Contact& contact : above) contact.n = -contact.n;
  EXPECT_EQ(Resistance(above, 9 * kWeight), 0);
}

TEST(LoadResistanceTest, ForcesBelowTheWeightDoNotCarryIt) {
  EXPECT_EQ(Resistance(Table(0.9, 0.1), 0.99 * kWeight), 0);
  EXPECT_GT(Resistance(Table(0.9, 0.1), 1.1 * kWeight), 0);
}

TEST(LoadResistanceTest, WithoutALoadItIsTheQuality) {
  RandomGrasps random(3);
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Grasp grasp = random.OnBall(3 + trial % 3, 3, 0.6);
    if (!IsForceClosure(grasp, kFrame, kFriction)) continue;
    const QualityBounds quality = ComputeQuality(grasp, kFrame, kFriction, 0.02);
    if (quality.lower < 1e-2) continue;
    const LoadResistance found = BoundLoadResistance(grasp, kFrame, kFriction, {}, 7, 1e-3);
    EXPECT_LE(found.lower, 7 * quality.upper * (1 + 1e-9));
    EXPECT_GE(found.upper, 7 * quality.lower * (1 - 1e-9));
    ++compared;
  }
  EXPECT_GE(compared, 5);
}

/// Linear programs are the second route: within the radius every disturbance is balanced, and
/// beyond it one is not.
TEST(LoadResistanceTest, ForcesExistWithinTheRadiusAndSomeDisturbanceBeyondItHasNone) {
  RandomGrasps random(5);
  int resisting = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Grasp grasp = random.OnBall(3 + trial % 2, 3, 0.6);
    const Wrench load{kWeight * random.Direction(3), Vector3d::Zero()};
    const double most = 6 * kWeight;
    const LoadResistance bounds = BoundLoadResistance(grasp, kFrame, kFriction, load, most, 1e-3);
    const auto is_balanced = [&](const Vector3d& force, const Vector3d& torque) {
      const Wrench all{load.force + force, load.torque_over_radius + torque};
      return ComputeSupportForces(grasp, kFrame, kFriction, all, most).balanced;
    };
    if (bounds.upper == 0) {
      EXPECT_FALSE(is_balanced(Vector3d::Zero(), Vector3d::Zero()));
      continue;
    }
    if (bounds.lower < 1e-3) continue;
    ++resisting;
    bool fails_beyond = false;
    for (int k = 0; k < 200; ++k) {
      Eigen::Matrix<double, 6, 1> d;
      for (double& x : d) x = random.Uniform(-1, 1);
      d.normalize();
      EXPECT_TRUE(
          is_balanced(0.999 * bounds.lower * d.head<3>(), 0.999 * bounds.lower * d.tail<3>()));
      fails_beyond = fails_beyond ||
                     !is_balanced(4 * bounds.upper * d.head<3>(), 4 * bounds.upper * d.tail<3>());
    }
    EXPECT_TRUE(fails_beyond);
  }
  EXPECT_GE(resisting, 20);
}

TEST(LoadResistanceTest, LawsOfOrderMotionScaleFrictionAndForce) {
  RandomGrasps random(8);
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Grasp grasp = random.OnBall(4, 3, 0.6);
    const Wrench load{kWeight * random.Direction(3), Vector3d::Zero()};
    const auto at = [&](const Grasp& of, const object::WrenchFrame& frame, const Wrench& with,
                        double friction, double most) {
      return BoundLoadResistance(of, frame, friction, with, most, 1e-3);
    };
    const LoadResistance bounds = at(grasp, kFrame, load, kFriction, 9);
    if (bounds.lower < 1e-2) continue;
    ++compared;
    const double slack = 2e-3 * bounds.upper;
    Grasp reversed(grasp.rbegin(), grasp.rend());
    EXPECT_NEAR(at(reversed, kFrame, load, kFriction, 9).lower, bounds.lower, slack);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()));
    const Vector3d shift(3, -1, 2);
    Grasp moved = grasp;
    for (Contact& contact : moved) {
      contact.p = turn * contact.p + shift;
      contact.n = turn * contact.n;
    }
    object::WrenchFrame moved_frame = kFrame;
    moved_frame.origin = turn * kFrame.origin + shift;
    EXPECT_NEAR(at(moved, moved_frame, {turn * load.force, Vector3d::Zero()}, kFriction, 9).lower,
                bounds.lower, slack);
    EXPECT_NEAR(at(grasp, kFrame, {3 * load.force, Vector3d::Zero()}, kFriction, 27).lower,
                3 * bounds.lower, 3 * slack);
    EXPECT_GE(at(grasp, kFrame, load, kFriction + 0.1, 9).upper, bounds.lower);
    EXPECT_GE(at(grasp, kFrame, load, kFriction, 12).upper, bounds.lower);
    EXPECT_TRUE(ResistsLoad(grasp, kFrame, kFriction, load, 9, 0.99 * bounds.lower));
    EXPECT_FALSE(ResistsLoad(grasp, kFrame, kFriction, load, 9, 1.01 * bounds.upper));
  }
  EXPECT_GE(compared, 20);
}

TEST(LoadResistanceTest, SupportForcesBalanceTheWeightWithNoMoreThanItNeeds) {
  const GraspForces forces =
      ComputeSupportForces(Table(0.9, 0.1), kFrame, kFriction, Weight(), 9 * kWeight);
  ASSERT_TRUE(forces.balanced);
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& force : forces.forces) sum += force;
  EXPECT_TRUE(sum.isApprox(kWeight * Vector3d::UnitZ(), 1e-9));
  EXPECT_GT(forces.margin, 0);
  // With exactly nine weights the same fingers cannot balance the object.
  EXPECT_FALSE(
      ComputeGraspForces(Table(0.9, 0.1), kFrame, kFriction, Weight(), 9 * kWeight).balanced);
}

TEST(LoadResistanceTest, SupportForcesOfAForceClosureGraspUseAllForce) {
  RandomGrasps random(4);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Grasp grasp = random.OnBall(4, 3, 0.6);
    if (!IsForceClosure(grasp, kFrame, kFriction)) continue;
    const GraspForces total = ComputeGraspForces(grasp, kFrame, kFriction, Weight(), 20 * kWeight);
    if (!total.balanced || total.margin < 1e-3) continue;
    ++compared;
    const GraspForces most = ComputeSupportForces(grasp, kFrame, kFriction, Weight(), 20 * kWeight);
    EXPECT_TRUE(most.balanced);
    EXPECT_NEAR(most.margin, total.margin, 1e-8);
  }
  EXPECT_GE(compared, 5);
}

TEST(LoadResistanceTest, BadArgumentsAreRejected) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Grasp table = Table(0.9, 0.1);
  EXPECT_THROW((void)BoundLoadResistance({}, kFrame, kFriction, Weight(), 9),
               std::invalid_argument);
  EXPECT_THROW((void)BoundLoadResistance(table, kFrame, 2, Weight(), 9), std::invalid_argument);
  EXPECT_THROW((void)BoundLoadResistance(table, kFrame, kFriction, Weight(), 0),
               std::invalid_argument);
  EXPECT_THROW((void)BoundLoadResistance(table, kFrame, kFriction, {Vector3d(nan, 0, 0)}, 9),
               std::invalid_argument);
  EXPECT_THROW((void)BoundLoadResistance(table, kFrame, kFriction, Weight(), 9, 1e-9),
               std::invalid_argument);
  EXPECT_THROW((void)ResistsLoad(table, kFrame, kFriction, Weight(), 9, 0), std::invalid_argument);
  EXPECT_THROW((void)ComputeSupportForces(table, kFrame, kFriction, Weight(), nan),
               std::invalid_argument);
}

}  // namespace load_resistance_test
}  // namespace regrasp::grasp
