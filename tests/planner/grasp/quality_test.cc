#include "planner/grasp/quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace quality_test {

/// Compute the support of the wrench set in a direction, independently of the library.
double Support(const Grasp& grasp, const object::WrenchFrame& frame, double friction_angle,
               const Eigen::Vector3d& v, const Eigen::Vector3d& omega) {
  double best = 0;
  for (const Contact& contact : grasp) {
    const Eigen::Vector3d u = v + omega.cross((contact.p - frame.origin) / frame.radius);
    const double normal = contact.n.dot(u);
    best = std::max(best, normal + std::tan(friction_angle) * (u - normal * contact.n).norm());
  }
  return best;
}

TEST(QualityTest, TwoOpposedFingersInThePlaneHaveTheInradiusOfTheirTetrahedron) {
  // The rim wrenches (1, ±μ, ∓μ) and (−1, ±μ, ±μ) form a tetrahedron. Its face through the first
  // two and (−1, μ, μ) has the normal (μ, 1, 1) and the offset μ. The other faces follow by
  // symmetry.
  for (const double degrees : {5.0, 20.0, 50.0}) {
    const double mu = std::tan(Radians(degrees));
    const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
    const QualityBounds bounds = ComputeQuality(grasp, UnitFrame(2), Radians(degrees), 1e-6);
    const double expected = mu / std::sqrt(mu * mu + 2);
    EXPECT_LE(bounds.lower, expected * (1 + 1e-9));
    EXPECT_GE(bounds.upper, expected * (1 - 1e-9));
    EXPECT_LE(bounds.upper - bounds.lower, 1e-6 * bounds.upper);
  }
}

TEST(QualityTest, BoundsNestAndTheUpperBoundIsNoMoreThanAnySupport) {
  RandomGrasps random(41);
  int checked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(dimension + 1, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(15, 45));
    if (!IsForceClosure(grasp, frame, friction_angle)) continue;
    const QualityBounds coarse = ComputeQuality(grasp, frame, friction_angle, 0.2);
    const QualityBounds fine = ComputeQuality(grasp, frame, friction_angle, 0.05);
    EXPECT_GT(coarse.lower, 0);
    EXPECT_LE(fine.upper - fine.lower, 0.05 * fine.upper);
    EXPECT_LE(fine.lower, coarse.upper);
    EXPECT_LE(coarse.lower, fine.upper);
    double least = coarse.upper;
    for (int direction = 0; direction < 20000; ++direction) {
      Eigen::Matrix<double, 6, 1> y;
      y << random.Uniform(-1, 1) * random.Direction(dimension),
          random.Uniform(-1, 1) *
              (dimension == 3 ? random.Direction(3) : Eigen::Vector3d::UnitZ().eval());
      y.normalize();
      least = std::min(least, Support(grasp, frame, friction_angle, y.head<3>(), y.tail<3>()));
    }
    EXPECT_LE(fine.lower, least);
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

TEST(QualityTest, AtLeastAgreesWithTheBounds) {
  RandomGrasps random(42);
  int above = 0;
  int below = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = trial % 4 == 1 ? random.OnBox(4, dimension) : random.OnBall(4, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(10, 40));
    const QualityBounds bounds = ComputeQuality(grasp, frame, friction_angle, 0.1);
    for (const double threshold : {0.5 * bounds.lower, 0.95 * bounds.lower}) {
      if (threshold <= 0) continue;
      EXPECT_TRUE(QualityAtLeast(grasp, frame, friction_angle, threshold));
      ++above;
    }
    for (const double threshold : {1.05 * bounds.upper, 3 * bounds.upper}) {
      if (threshold <= 0) continue;
      EXPECT_FALSE(QualityAtLeast(grasp, frame, friction_angle, threshold));
      ++below;
    }
  }
  EXPECT_GT(above, 50);
  EXPECT_GT(below, 50);
}

TEST(QualityTest, AtLeastIsNeverMoreThanThereIs) {
  RandomGrasps random(49);
  int checked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(4, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(10, 40));
    const double upper = ComputeQuality(grasp, frame, friction_angle, 0.02).upper;
    if (upper <= 0) continue;
    EXPECT_FALSE(QualityAtLeast(grasp, frame, friction_angle, 1.002 * upper)) << trial;
    ++checked;
  }
  EXPECT_GT(checked, 15);
}

TEST(QualityTest, OrderRigidMotionAndUnitDoNotMatterAndMoreIsNeverWorse) {
  RandomGrasps random(43);
  int checked = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Grasp grasp = random.OnBall(4, 3);
    const double friction_angle = Radians(random.Uniform(15, 30));
    const QualityBounds bounds = ComputeQuality(grasp, UnitFrame(3), friction_angle, 0.1);
    if (bounds.upper <= 0) continue;
    ++checked;
    const double unit = std::pow(10, random.Uniform(-6, 6));
    const Eigen::Matrix3d turn = random.Rotation(3);
    const Eigen::Vector3d shift = unit * random.Direction(3);
    Grasp moved;
    for (const Contact& contact : grasp) {
      moved.insert(moved.begin(), {unit * (turn * contact.p) + shift, turn * contact.n});
    }
    const QualityBounds same = ComputeQuality(moved, {shift, unit, 3}, friction_angle, 0.1);
    EXPECT_LE(same.lower, bounds.upper);
    EXPECT_LE(bounds.lower, same.upper);
    const QualityBounds more_friction =
        ComputeQuality(grasp, UnitFrame(3), 1.2 * friction_angle, 0.1);
    EXPECT_GE(more_friction.upper, bounds.lower);
    Grasp more = grasp;
    more.push_back(random.OnBall(1, 3).front());
    EXPECT_GE(ComputeQuality(more, UnitFrame(3), friction_angle, 0.1).upper, bounds.lower);
  }
  EXPECT_GT(checked, 10);
}

TEST(QualityTest, IsBoundedWithLittleWorkNearTheCriticalFriction) {
  RandomGrasps random(44);
  int checked = 0;
  for (int trial = 0; trial < 200 && checked < 4; ++trial) {
    const Grasp grasp = random.OnBall(3, 3);
    const auto required = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
    if (!required || required->lower < Radians(5) || required->upper > Radians(60)) continue;
    for (const double above : {1e-7, 1e-4}) {
      const double friction_angle = std::atan((1 + above) * std::tan(required->upper));
      const QualityBounds bounds = ComputeQuality(grasp, UnitFrame(3), friction_angle);
      EXPECT_GT(bounds.upper, 0);
      EXPECT_LT(bounds.upper, 1e-4);
      EXPECT_LE(bounds.upper - bounds.lower, std::max(kQualityGap, 0.01 * bounds.upper));
      // Without kQualityGap some grasps create 60,000 facets for irrelevant digits.
      EXPECT_LT(bounds.facets, 40'000);
    }
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

TEST(QualityTest, EndsItsWorkWithBoundsThatMayBeFarApart) {
  // The gap is below the rounding error, and the wrench set is almost round: without the limit the
  // work is four times as much.
  RandomGrasps random(45);
  const Grasp grasp = random.OnBall(24, 3);
  const double friction_angle = Radians(20);
  ASSERT_TRUE(IsForceClosure(grasp, UnitFrame(3), friction_angle));
  const QualityBounds bounds = ComputeQuality(grasp, UnitFrame(3), friction_angle, 1e-12);
  EXPECT_LE(bounds.lower, bounds.upper);
  EXPECT_GE(bounds.facets, kMostQualityFacets);
  EXPECT_LT(bounds.facets, 2 * kMostQualityFacets);
  const QualityBounds coarse = ComputeQuality(grasp, UnitFrame(3), friction_angle, 0.1);
  EXPECT_LE(coarse.lower, bounds.upper);
  EXPECT_LE(bounds.lower, coarse.upper);
}

TEST(QualityTest, IsToldByOneNumberWhereItIsKnownWell) {
  EXPECT_EQ(QualityText({0.121, 0.122}), "0.121");
  EXPECT_EQ(QualityText({0, 0}), "0");
  EXPECT_EQ(QualityText({0, 1e-6}), "at least 0, at most 1e-06");
}

TEST(QualityTest, IsZeroWithoutForceClosure) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_EQ(ComputeQuality(grasp, UnitFrame(3), 0.5).upper, 0);
  EXPECT_FALSE(QualityAtLeast(grasp, UnitFrame(3), 0.5, 1e-9));
  EXPECT_TRUE(QualityAtLeast(grasp, UnitFrame(2), 0.5, 1e-9));
}

TEST(QualityTest, BadArgumentsThrow) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_THROW((void)ComputeQuality(grasp, UnitFrame(2), 0.5, 0), std::invalid_argument);
  EXPECT_THROW((void)ComputeQuality(grasp, UnitFrame(2), 0, 0.1), std::invalid_argument);
  EXPECT_THROW((void)QualityAtLeast(grasp, UnitFrame(2), 0.5, std::nan("")), std::invalid_argument);
}

}  // namespace quality_test
}  // namespace regrasp::grasp
