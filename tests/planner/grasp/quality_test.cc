#include "planner/grasp/quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
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

namespace bound_quality_test {

constexpr double kGap = 0.01;
/// Limit of created facets of the hull for four contacts. It limits the time identically on every
/// machine.
constexpr int kFewFacets = 30'000;

/// Compute the support of the wrench set along a unit twist, independently of the library.
double Support(const Grasp& grasp, const object::WrenchFrame& frame, double friction_angle,
               const Eigen::Matrix<double, 6, 1>& y) {
  double best = 0;
  for (const Contact& contact : grasp) {
    const Eigen::Vector3d arm = (contact.p - frame.origin) / frame.radius;
    const Eigen::Vector3d u = y.head<3>() + y.tail<3>().cross(arm);
    const double normal = contact.n.dot(u);
    const double spin = contact.torsion / frame.radius * contact.n.dot(y.tail<3>());
    const double sliding = (u - normal * contact.n).norm();
    best = std::max(best, normal + std::tan(friction_angle) * std::hypot(sliding, spin));
  }
  return best;
}

/// Return the least support over random twists, each improved by random descent steps.
double LeastSupport(const Grasp& grasp, double friction_angle, RandomGrasps& random) {
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 100; ++start) {
    Eigen::Matrix<double, 6, 1> y;
    y << random.Uniform(0, 1) * random.Direction(3), random.Uniform(0, 1) * random.Direction(3);
    y.normalize();
    double here = Support(grasp, UnitFrame(3), friction_angle, y);
    for (double step = 0.5; step > 1e-3; step *= 0.97) {
      Eigen::Matrix<double, 6, 1> z;
      z << random.Direction(3), random.Direction(3);
      z = (y + step * z).normalized();
      const double there = Support(grasp, UnitFrame(3), friction_angle, z);
      if (there < here) std::tie(y, here) = std::pair(z, there);
    }
    least = std::min(least, here);
  }
  return least;
}

/// Compute the quality by Qhull's hull of pyramids with `sides` sides.
/// @param outside  true: the pyramids contain the cones; false: they are inscribed.
double QualityOfPyramids(const Grasp& grasp, double friction_angle, int sides, bool outside) {
  const double mu = std::tan(friction_angle) / (outside ? std::cos(std::numbers::pi / sides) : 1);
  Eigen::MatrixXd wrenches(6, 1 + sides * static_cast<int>(grasp.size()));
  wrenches.col(0).setZero();
  int column = 1;
  for (const Contact& contact : grasp) {
    const Eigen::Vector3d first = contact.n.unitOrthogonal();
    const Eigen::Vector3d second = contact.n.cross(first);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      const Eigen::Vector3d force =
          contact.n + mu * (std::cos(angle) * first + std::sin(angle) * second);
      wrenches.col(column++) << force, contact.p.cross(force);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const HullFacet& facet : ComputeConvexHull(wrenches).facets) {
    least = std::min(least, facet.offset);
  }
  return least;
}

/// Return grasps of four, six and three contacts with many equal minima and coplanar wrenches.
std::vector<std::pair<std::string, Grasp>> SymmetricGrasps() {
  std::vector<std::pair<std::string, Grasp>> grasps(4);
  const auto add = [](Grasp& to, const Eigen::Vector3d& p) { to.push_back({p, -p.normalized()}); };
  grasps[0].first = "square";
  grasps[1].first = "tetrahedron";
  grasps[2].first = "octahedron";
  grasps[3].first = "triangle";
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3;
    add(grasps[3].second, {std::cos(angle), std::sin(angle), 0});
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d p = side * Eigen::Vector3d::Unit(i);
      if (i < 2) add(grasps[0].second, p);
      add(grasps[2].second, p);
    }
  }
  for (const auto& corner : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                             Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
    add(grasps[1].second, corner.normalized());
  }
  return grasps;
}

/// Compute bounds by the hull itself, because ComputeQuality may use another method.
QualityBounds Bound(const Grasp& grasp, const object::WrenchFrame& frame, double friction_angle,
                    double gap = kGap) {
  const auto bounds = BoundQualityByHull(grasp, frame, friction_angle, gap);
  EXPECT_TRUE(bounds) << "rounding broke the hull";
  return bounds.value_or(QualityBounds{});
}

void ExpectOverlap(const QualityBounds& a, const QualityBounds& b, const std::string& what) {
  EXPECT_LE(a.lower, b.upper * (1 + 1e-9)) << what;
  EXPECT_LE(b.lower, a.upper * (1 + 1e-9)) << what;
}

TEST(BoundQualityTest, TwoOpposedFingersInThePlaneHaveTheInradiusOfTheirTetrahedron) {
  for (const double degrees : {5.0, 20.0, 50.0, 85.0}) {
    const double mu = std::tan(Radians(degrees));
    const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
    const QualityBounds bounds = Bound(grasp, UnitFrame(2), Radians(degrees), 1e-5);
    const double expected = mu / std::sqrt(mu * mu + 2);
    EXPECT_LE(bounds.lower, expected);
    EXPECT_GE(bounds.upper, expected * (1 - 1e-9));
    EXPECT_LE(bounds.upper - bounds.lower, 1e-5 * bounds.upper);
  }
}

TEST(BoundQualityTest, BoundsOverlapThoseOfQhullWithinOnePercent) {
  RandomGrasps random(141);
  int checked = 0;
  for (int trial = 0; trial < 240; ++trial) {
    const int dimension = trial % 3 == 0 ? 2 : 3;
    const int count = dimension + 1 + trial / 3 % 5;
    const Grasp grasp =
        trial % 2 == 0 ? random.OnBall(count, dimension) : random.OnBox(count, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const double friction_angle = Radians(random.Uniform(5, 60));
    if (!IsForceClosure(grasp, frame, friction_angle)) continue;
    const QualityBounds bounds = Bound(grasp, frame, friction_angle);
    EXPECT_LE(bounds.upper - bounds.lower, std::max(kGap * bounds.upper, kQualityGap)) << trial;
    ExpectOverlap(bounds, ComputeQuality(grasp, frame, friction_angle, 0.1), std::to_string(trial));
    if (count == 4) {
      EXPECT_LT(bounds.facets, kFewFacets) << trial;
    }
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(BoundQualityTest, LiesBetweenDensePyramidsInsideAndOutsideTheCones) {
  RandomGrasps random(142);
  int checked = 0;
  for (int trial = 0; trial < 60 && checked < 6; ++trial) {
    const Grasp grasp = trial % 2 == 0 ? random.OnBall(4, 3) : random.OnBox(4, 3);
    const double friction_angle = Radians(random.Uniform(15, 35));
    if (!IsForceClosure(grasp, UnitFrame(3), friction_angle)) continue;
    const QualityBounds bounds = Bound(grasp, UnitFrame(3), friction_angle);
    if (bounds.upper < 0.01) continue;  // the pyramids are too inaccurate there
    ++checked;
    EXPECT_GE(bounds.upper, QualityOfPyramids(grasp, friction_angle, 16, false) - 1e-6);
    EXPECT_LE(bounds.lower, QualityOfPyramids(grasp, friction_angle, 16, true) + 1e-6);
    // Pyramids with four sides are so inaccurate that the comparison can fail.
    EXPECT_GT(bounds.lower, QualityOfPyramids(grasp, friction_angle, 4, false));
  }
  EXPECT_EQ(checked, 6);
}

TEST(BoundQualityTest, NoTwistHasALowerSupport) {
  RandomGrasps random(143);
  int checked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Grasp grasp = trial % 2 == 0 ? random.OnBall(4, 3) : random.OnBox(4, 3);
    if (trial % 3 == 0) {
      for (Contact& contact : grasp) contact.torsion = 0.3;
    }
    const double friction_angle = Radians(random.Uniform(15, 45));
    if (!IsForceClosure(grasp, UnitFrame(3), friction_angle)) continue;
    const QualityBounds bounds = Bound(grasp, UnitFrame(3), friction_angle);
    const double least = LeastSupport(grasp, friction_angle, random);
    EXPECT_LE(bounds.lower, least) << trial;
    EXPECT_LE(bounds.upper, least * 1.05 + 1e-3) << trial << ": the search found a better twist";
    ++checked;
  }
  EXPECT_GT(checked, 15);
}

TEST(BoundQualityTest, SymmetricGraspsAreBoundedWithFewFacets) {
  for (const auto& [name, grasp] : SymmetricGrasps()) {
    for (const double degrees : {6.0, 20.0, 45.0}) {
      const QualityBounds bounds = Bound(grasp, UnitFrame(3), Radians(degrees));
      EXPECT_GT(bounds.lower, 0) << name;
      EXPECT_LE(bounds.upper - bounds.lower, kGap * bounds.upper) << name;
      EXPECT_LT(bounds.facets, name == "triangle" ? 3 * kFewFacets : kFewFacets)
          << name << " " << degrees;
      ExpectOverlap(bounds, ComputeQuality(grasp, UnitFrame(3), Radians(degrees), 0.2), name);
    }
  }
}

TEST(BoundQualityTest, OrderRigidMotionAndUnitDoNotMatterAndMoreIsNeverWorse) {
  RandomGrasps random(144);
  int checked = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Grasp grasp = trial % 2 == 0 ? random.OnBall(4, 3) : random.OnBox(4, 3);
    const double friction_angle = Radians(random.Uniform(15, 30));
    if (!IsForceClosure(grasp, UnitFrame(3), friction_angle)) continue;
    ++checked;
    const QualityBounds bounds = Bound(grasp, UnitFrame(3), friction_angle);
    const double unit = std::pow(10, random.Uniform(-6, 6));
    const Eigen::Matrix3d turn = random.Rotation(3);
    const Eigen::Vector3d shift = unit * random.Direction(3);
    Grasp moved;
    for (const Contact& contact : grasp) {
      moved.insert(moved.begin(), {unit * (turn * contact.p) + shift, turn * contact.n});
    }
    ExpectOverlap(bounds, Bound(moved, {shift, unit, 3}, friction_angle), "moved and reversed");
    EXPECT_GE(Bound(grasp, UnitFrame(3), 1.2 * friction_angle).upper, bounds.lower);
    Grasp more = grasp;
    more.push_back(random.OnBall(1, 3).front());
    EXPECT_GE(Bound(more, UnitFrame(3), friction_angle).upper, bounds.lower);
    // Negative control: less friction reduces the quality by more than the gap.
    const QualityBounds less = BoundQuality(grasp, UnitFrame(3), 0.8 * friction_angle);
    EXPECT_LT(less.upper, bounds.lower);
  }
  EXPECT_GT(checked, 15);
}

TEST(BoundQualityTest, SoftFingersAreBoundedToo) {
  // Two opposed soft fingers resist the torque about their line least: μ · torsion / 2.
  for (const double torsion : {0.01, 0.1}) {
    Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
    for (Contact& contact : grasp) contact.torsion = torsion;
    const QualityBounds bounds = Bound(grasp, UnitFrame(3), Radians(30));
    ExpectOverlap(bounds, ComputeQuality(grasp, UnitFrame(3), Radians(30), 0.05), "soft pair");
    EXPECT_LE(bounds.upper, 1.01 * std::tan(Radians(30)) * torsion);
    EXPECT_GE(bounds.lower, 0.9 * std::tan(Radians(30)) * torsion);
  }
}

TEST(BoundQualityTest, IsBoundedNearTheCriticalFriction) {
  RandomGrasps random(145);
  int checked = 0;
  for (int trial = 0; trial < 200 && checked < 6; ++trial) {
    const Grasp grasp = random.OnBall(3 + trial % 2, 3);
    const auto required = ComputeRequiredFrictionAngle(grasp, UnitFrame(3));
    if (!required || required->lower < Radians(5) || required->upper > Radians(60)) continue;
    for (const double above : {1e-9, 1e-7, 1e-5, 1e-3}) {
      const double friction_angle = std::atan((1 + above) * std::tan(required->upper));
      const QualityBounds bounds = BoundQuality(grasp, UnitFrame(3), friction_angle);
      EXPECT_GT(bounds.upper, 0) << above;
      EXPECT_LE(bounds.upper - bounds.lower, std::max(kQualityGap, kGap * bounds.upper)) << above;
      EXPECT_LT(bounds.facets, 3 * kFewFacets) << above;
    }
    ++checked;
  }
  EXPECT_EQ(checked, 6);
}

TEST(BoundQualityTest, ExtremeFrictionIsBounded) {
  for (const auto& [name, grasp] : SymmetricGrasps()) {
    for (const double mu : {1e-3, 10.0, 1e3, 1e6, 1e12}) {
      const double friction_angle = std::atan(mu);
      const QualityBounds bounds = BoundQuality(grasp, UnitFrame(3), friction_angle, 0.1);
      EXPECT_LE(bounds.lower, bounds.upper) << name << " " << mu;
      EXPECT_GE(bounds.lower, 0) << name << " " << mu;
      EXPECT_TRUE(std::isfinite(bounds.upper)) << name << " " << mu;
      if (mu <= 1e6) {
        EXPECT_GE(bounds.lower, 0.9 * bounds.upper) << name << " " << mu;
      }
    }
  }
}

TEST(BoundQualityTest, EndsItsWorkWithBoundsThatMayBeFarApart) {
  RandomGrasps random(146);
  const Grasp grasp = random.OnBall(24, 3);
  const QualityBounds bounds = BoundQuality(grasp, UnitFrame(3), Radians(20), kLeastRelativeGap);
  EXPECT_LE(bounds.lower, bounds.upper);
  EXPECT_LT(bounds.facets, 2 * kMostQualityFacets);
  ExpectOverlap(bounds, Bound(grasp, UnitFrame(3), Radians(20), 0.1), "24 contacts");
}

TEST(BoundQualityTest, IsZeroWithoutForceClosure) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_EQ(BoundQuality(grasp, UnitFrame(3), 0.5).upper, 0);
  EXPECT_GT(BoundQuality(grasp, UnitFrame(2), 0.5).lower, 0);
}

TEST(BoundQualityTest, BadArgumentsThrow) {
  const Grasp grasp{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_THROW((void)BoundQuality(grasp, UnitFrame(2), 0.5, 0.5 * kLeastRelativeGap),
               std::invalid_argument);
  EXPECT_THROW((void)BoundQuality(grasp, UnitFrame(2), 0.5, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)BoundQuality(grasp, UnitFrame(2), 0), std::invalid_argument);
}

}  // namespace bound_quality_test
}  // namespace regrasp::grasp
