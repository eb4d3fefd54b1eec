// Contacts with torsional friction (soft fingers) in all computations on a single grasp.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/number.h"
#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/quality_rays.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/subset_force_closure.h"
#include "pyramid_program.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace soft_fingers_test {

using Eigen::Vector3d;

const object::WrenchFrame kFrame = UnitFrame(3);

Grasp Soft(Grasp grasp, double torsion) {
  for (Contact& contact : grasp) contact.torsion = torsion;
  return grasp;
}

/// Return contacts on two opposite faces of a cube of side 2, the second offset from the line of
/// the first.
Grasp Pair(double torsion, double offset = 0) {
  return Soft({{{-1, 0, 0}, {1, 0, 0}}, {{1, offset, 0}, {-1, 0, 0}}}, torsion);
}

Decision Decide(const Grasp& grasp, double friction_angle) {
  return TestForceClosure(grasp, kFrame, friction_angle).decision;
}

/// Return random soft fingers, two to five, on a sphere or a box.
Grasp Draw(RandomGrasps& random, int trial) {
  const int count = 2 + trial % 4;
  Grasp grasp = trial % 8 < 4 ? random.OnBall(count, 3) : random.OnBox(count, 3);
  return Soft(std::move(grasp), std::pow(10, random.Uniform(-2, 0)));
}

TEST(SoftFingersTest, TwoOnACubeHoldItAndHardPointsDoNot) {
  for (const double torsion : {1e-3, 0.1, 10.0}) {
    for (const double degrees : {1.0, 20.0, 80.0}) {
      EXPECT_EQ(Decide(Pair(torsion), Radians(degrees)), Decision::kYes) << torsion;
      EXPECT_EQ(Decide(Pair(0), Radians(degrees)), Decision::kNo);
    }
  }
  // One soft finger is sufficient for the torque about the line.
  Grasp one = Pair(0);
  one[0].torsion = 0.1;
  EXPECT_EQ(Decide(one, Radians(20)), Decision::kYes);
}

TEST(SoftFingersTest, TwoNeedTheAngleOfTheirOffset) {
  // Opposite normals: forces that are not along the line have torques that torsional friction
  // cannot balance.
  for (const double offset : {0.0, 0.1, 0.5, 1.0, 3.0}) {
    for (const double torsion : {0.01, 1.0}) {
      const auto required = ComputeRequiredFrictionAngle(Pair(torsion, offset), kFrame);
      ASSERT_TRUE(required);
      EXPECT_NEAR(required->lower, std::atan(offset / 2), 1e-6);
      EXPECT_NEAR(required->upper, std::atan(offset / 2), 1e-6);
    }
  }
  EXPECT_FALSE(ComputeRequiredFrictionAngle(Pair(0), kFrame));
}

TEST(SoftFingersTest, TwoBentAcrossEachOtherNeedWhatTheirTorsionLeaves) {
  // Normals tilted by β, one towards y and one towards z. Forces ±(a, b, −b) have the torques ∓2b
  // (0, 1, 1), which torques of 2b/sin β about both normals balance. The normal forces are a cos β
  // + b sin β. Hence μ² + 1 is the minimum of (a² + k b²) / (a cos β + b sin β)², with k = 2 + 4 /
  // (e sin β)², which is 1 / (cos² β + sin² β / k).
  for (const double bend : {Radians(10), Radians(30), Radians(50)}) {
    double before = bend;
    for (const double torsion : {0.03, 0.3, 3.0, 30.0}) {
      const double s = std::sin(bend), c = std::cos(bend);
      const Grasp grasp = Soft({{{-1, 0, 0}, {c, s, 0}}, {{1, 0, 0}, {-c, 0, s}}}, torsion);
      const double k = 2 + 4 / (torsion * torsion * s * s);
      const double expected = std::atan(std::sqrt(1 / (c * c + s * s / k) - 1));
      const auto required = ComputeRequiredFrictionAngle(grasp, kFrame);
      ASSERT_TRUE(required);
      EXPECT_NEAR(required->lower, expected, 1e-6) << bend << " " << torsion;
      EXPECT_NEAR(required->upper, expected, 1e-6) << bend << " " << torsion;
      EXPECT_LT(required->upper, before);
      before = required->lower;
    }
  }
}

TEST(SoftFingersTest, NoTorsionHelpsWhereTheNormalsAreAcrossTheLine) {
  // A blade along x: all fingers are on its line, so that only a torque about x resists a rotation
  // about it. Their normals are y and z.
  const Grasp blade = {{{-1, 0, 0}, {0, 1, 0}},
                       {{-1, 0, 0}, {0, -1, 0}},
                       {{1, 0, 0}, {0, 0, 1}},
                       {{1, 0, 0}, {0, 0, -1}}};
  EXPECT_EQ(Decide(Soft(blade, 0.5), Radians(40)), Decision::kNo);
  Grasp bent = blade;
  bent[0].n = Vector3d(0.2, 1, 0).normalized();
  EXPECT_EQ(Decide(Soft(bent, 0.5), Radians(40)), Decision::kYes);
  EXPECT_EQ(Decide(bent, Radians(40)), Decision::kNo);
}

TEST(SoftFingersTest, AgreesWithInscribedAndCircumscribedPolyhedra) {
  constexpr Pyramid kInside{40, false}, kOutside{40, true};
  /// Feasibility tolerance of GLPK is 1e-7, so margins below this are not significant.
  constexpr double kTolerance = 1e-6;
  RandomGrasps random(71);
  int yes = 0, no = 0, between = 0, helped = 0;
  for (int trial = 0; trial < 160; ++trial) {
    const Grasp grasp = Draw(random, trial);
    const double friction_angle = Radians(random.Uniform(5, 60));
    const ForceClosure answer = TestForceClosure(grasp, kFrame, friction_angle);
    EXPECT_LE(answer.margin_lower, answer.margin_upper);
    const auto inside = PyramidMargin(grasp, kFrame, friction_angle, kInside, {});
    const auto outside = PyramidMargin(grasp, kFrame, friction_angle, kOutside, {});
    if (inside && *inside > kTolerance) {
      EXPECT_EQ(answer.decision, Decision::kYes) << trial;
      // A program's margin m is a share of the mean normal force, of which it takes its part: ε = m
      // / (k (1 − m)).
      const auto epsilon = [&](double m) {
        return m / (static_cast<double>(grasp.size()) * (1 - m));
      };
      ASSERT_TRUE(outside);
      EXPECT_LE(answer.margin_lower, epsilon(*outside) + kTolerance);
      EXPECT_GE(answer.margin_upper, epsilon(*inside) - kTolerance);
      if (Decide(Soft(grasp, 0), friction_angle) == Decision::kNo) ++helped;
      ++yes;
    } else if (!outside || *outside < -kTolerance) {
      EXPECT_EQ(answer.decision, Decision::kNo) << trial;
      ++no;
    } else {
      ++between;
    }
  }
  EXPECT_GT(yes, 40);
  EXPECT_GT(no, 40);
  EXPECT_GT(helped, 10);
  EXPECT_LT(between, 16);
}

TEST(SoftFingersTest, ATorsionOfZeroHasTheBitsOfHardPoints) {
  RandomGrasps random(72);
  for (int trial = 0; trial < 400; ++trial) {
    const Grasp hard = random.OnBall(3 + trial % 4, 3);
    const double friction_angle = Radians(random.Uniform(5, 60));
    const ForceClosure answer = TestForceClosure(hard, kFrame, friction_angle);
    const ForceClosure zero = TestForceClosure(Soft(hard, 0), kFrame, friction_angle);
    EXPECT_EQ(zero.decision, answer.decision);
    EXPECT_EQ(zero.margin_lower, answer.margin_lower);
    EXPECT_EQ(zero.margin_upper, answer.margin_upper);
  }
}

TEST(SoftFingersTest, OfFingersThatDoNotTwistAlmostNoTorsionChangesAlmostNothing) {
  // Three fingers with tilted normals require their tilt, because no two of them balance.
  for (const double torsion : {0.0, 1e-9, 1e-6}) {
    Grasp grasp;
    for (int i = 0; i < 3; ++i) {
      const double angle = Radians(120.0 * i);
      const Vector3d p(std::cos(angle), std::sin(angle), 0);
      grasp.push_back({p, std::sin(Radians(20)) * Vector3d::UnitZ() - std::cos(Radians(20)) * p});
    }
    const auto required = ComputeRequiredFrictionAngle(Soft(grasp, torsion), kFrame);
    ASSERT_TRUE(required);
    EXPECT_NEAR(required->upper, Radians(20), 1e-5);
  }
}

TEST(SoftFingersTest, MoreFrictionTorsionOrContactsNeverLoseForceClosure) {
  RandomGrasps random(73);
  int held = 0, held_hard = 0, smaller = 0;
  for (int trial = 0; trial < 800; ++trial) {
    const Grasp grasp = Draw(random, trial);
    const double torsion = grasp.front().torsion;
    const double friction_angle = Radians(random.Uniform(5, 60));
    if (Decide(Soft(grasp, 0), friction_angle) == Decision::kYes) {
      EXPECT_EQ(Decide(grasp, friction_angle), Decision::kYes) << trial;
      ++held_hard;
    }
    if (Decide(grasp, friction_angle) != Decision::kYes) continue;
    ++held;
    EXPECT_EQ(Decide(grasp, 1.1 * friction_angle), Decision::kYes) << trial;
    EXPECT_EQ(Decide(Soft(grasp, 1.5 * torsion), friction_angle), Decision::kYes) << trial;
    Grasp more = grasp;
    more.push_back(random.OnBall(1, 3).front());
    EXPECT_EQ(Decide(more, friction_angle), Decision::kYes) << trial;
    const auto required = ComputeRequiredFrictionAngle(grasp, kFrame);
    const auto with_more = ComputeRequiredFrictionAngle(Soft(grasp, 1.5 * torsion), kFrame);
    ASSERT_TRUE(required && with_more);
    EXPECT_LE(with_more->lower, required->upper);
    if (with_more->upper < required->lower) ++smaller;
  }
  EXPECT_GT(held, 200);
  EXPECT_GT(held_hard, 60);
  EXPECT_GT(smaller, 60);
}

TEST(SoftFingersTest, OrderRigidMotionAndUnitDoNotMatter) {
  RandomGrasps random(74);
  int yes = 0, no = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Grasp grasp = Draw(random, trial);
    const double friction_angle = Radians(random.Uniform(10, 50));
    const Decision decision = Decide(grasp, friction_angle);
    if (decision == Decision::kTooClose) continue;
    (decision == Decision::kYes ? yes : no) += 1;
    const double unit = std::pow(10, random.Uniform(-4, 4));
    const Eigen::Matrix3d turn = random.Rotation(3);
    const Vector3d shift = unit * random.Direction(3);
    Grasp moved;
    for (const Contact& contact : grasp) {
      moved.insert(moved.begin(), {unit * (turn * contact.p) + shift, turn * contact.n,
                                   contact.face, unit * contact.torsion});
    }
    const object::WrenchFrame frame{shift, unit, 3};
    EXPECT_EQ(TestForceClosure(moved, frame, friction_angle).decision, decision) << trial;
    if (decision != Decision::kYes || yes % 8 != 0) continue;
    const QualityBounds quality = ComputeQuality(grasp, kFrame, friction_angle, 0.3);
    const QualityBounds same = ComputeQuality(moved, frame, friction_angle, 0.3);
    EXPECT_LE(same.lower, quality.upper * (1 + 1e-9));
    EXPECT_LE(quality.lower, same.upper * (1 + 1e-9));
  }
  EXPECT_GT(yes, 60);
  EXPECT_GT(no, 60);
}

TEST(SoftFingersTest, TheRimWrenchAttainsTheSupportAndNoOtherExceedsIt) {
  RandomGrasps random(75);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d n = random.Direction(3);
    const UnitContact contact{random.Direction(3), n, 0.8, 0.6, random.Uniform(0, 2)};
    const Vector3d u = random.Uniform(0, 2) * random.Direction(3);
    const double spin = random.Uniform(-2, 2);
    const auto power = [&](const ContactWrench& w) { return u.dot(w.force) + spin * w.torque; };
    const double support = ConeSupport(contact, u, spin);
    const ContactWrench best = SupportWrench<6>(contact, u, spin);
    EXPECT_NEAR(power(best), support, 1e-12);
    EXPECT_NEAR(best.force.dot(n), contact.axial, 1e-12);
    const double tangential = (best.force - contact.axial * n).norm();
    const double twist = contact.torsion > 0 ? best.torque / contact.torsion : 0;
    EXPECT_NEAR(std::hypot(tangential, twist), contact.tangential, 1e-12);
    for (int other = 0; other < 20; ++other) {
      const Vector3d t = n.cross(random.Direction(3)).normalized();
      const double angle = random.Uniform(0, 2 * std::numbers::pi);
      EXPECT_LE(power({contact.axial * n + contact.tangential * std::cos(angle) * t,
                       contact.tangential * contact.torsion * std::sin(angle)}),
                support + 1e-12);
    }
  }
}

TEST(SoftFingersTest, APairBearsForceAndTorqueOnAnEllipse) {
  // Both fingers exert half of the total normal force. Their tangential force F and their torque T
  // about the line satisfy (F / μ)² + (T / (μ e))² = 1.
  const double friction_angle = Radians(20), mu = std::tan(friction_angle), torsion = 0.3;
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0}) {
    const double c = std::cos(Radians(degrees)), s = std::sin(Radians(degrees));
    const auto largest = ComputeLargestLoad(Pair(torsion), kFrame, friction_angle, {},
                                            {{0, c, 0}, {torsion * s, 0, 0}}, 7);
    ASSERT_TRUE(largest);
    EXPECT_NEAR(largest->lower, mu, 1e-6) << degrees;
    EXPECT_NEAR(largest->upper, mu, 1e-6) << degrees;
  }
  // Hard contacts resist no torque about their line.
  const auto none = ComputeLargestLoad(Pair(0), kFrame, friction_angle, {}, {{}, {1, 0, 0}}, 7);
  ASSERT_TRUE(none);
  EXPECT_NEAR(none->upper, 0, 1e-6);
}

TEST(SoftFingersTest, TheQualityOfAPairIsWhatItBearsAboutItsLine) {
  const double friction_angle = Radians(20), mu = std::tan(friction_angle);
  for (const double torsion : {0.02, 0.1, 0.4}) {
    const QualityBounds quality = ComputeQuality(Pair(torsion), kFrame, friction_angle, 0.1);
    EXPECT_LE(quality.lower, mu * torsion * (1 + 1e-9));
    EXPECT_GE(quality.upper, mu * torsion * (1 - 1e-9));
    EXPECT_LE(quality.upper - quality.lower, 0.101 * quality.upper);
    EXPECT_TRUE(QualityAtLeast(Pair(torsion), kFrame, friction_angle, 0.95 * mu * torsion));
    EXPECT_FALSE(QualityAtLeast(Pair(torsion), kFrame, friction_angle, 1.05 * mu * torsion));
    QualityFilter filter(kFrame, friction_angle);
    EXPECT_FALSE(filter.IsClearlyAtLeast(Pair(torsion), 1.05 * mu * torsion));
  }
  EXPECT_EQ(ComputeQuality(Pair(0), kFrame, friction_angle).upper, 0);
}

TEST(SoftFingersTest, ForcesAndTorquesBalanceTheLoadInsideTheEllipsoids) {
  RandomGrasps random(76);
  const double friction_angle = Radians(30), mu = std::tan(friction_angle), total = 5;
  const object::WrenchFrame frame{{0.1, -0.2, 0.3}, 1.7, 3};
  int balanced = 0, twisting = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Grasp grasp = Draw(random, trial);
    const Wrench load{0.2 * random.Direction(3), 0.1 * random.Direction(3)};
    const GraspForces found = ComputeGraspForces(grasp, frame, friction_angle, load, total);
    ASSERT_EQ(found.torques.size(), grasp.size());
    if (!found.balanced) continue;
    ++balanced;
    Vector3d force = load.force, torque = load.torque_over_radius * frame.radius;
    for (std::size_t i = 0; i < grasp.size(); ++i) {
      const Vector3d& f = found.forces[i];
      const Contact& contact = grasp[i];
      force += f;
      torque += (contact.p - frame.origin).cross(f) + found.torques[i] * contact.n;
      const double normal = f.dot(contact.n);
      const double twist = found.torques[i] / contact.torsion;
      EXPECT_LE(std::hypot((f - normal * contact.n).norm(), twist), mu * normal + 1e-8);
      if (std::abs(twist) > 0.01) ++twisting;
    }
    EXPECT_LT(force.norm(), 1e-7);
    EXPECT_LT(torque.norm(), 1e-7);
  }
  EXPECT_GT(balanced, 60);
  EXPECT_GT(twisting, 60);
}

TEST(SoftFingersTest, OfAPairEachFingerNeedsTheOther) {
  const auto fingers = MeasureFingerFriction(Pair(0.2, 0.5), kFrame, Radians(30));
  ASSERT_EQ(fingers.size(), 2U);
  for (const FingerFriction& finger : fingers) {
    EXPECT_TRUE(finger.needed);
    EXPECT_FALSE(finger.without);
    EXPECT_NEAR(finger.required, std::atan(0.25), 1e-6);
  }
  EXPECT_TRUE(MeasureFingerFriction(Pair(0, 0.5), kFrame, Radians(30)).empty());
}

TEST(SoftFingersTest, AtOnePointNothingIsDecided) {
  Grasp grasp;
  for (const Vector3d& n : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0)}) {
    grasp.push_back({{0, 0, 0}, n});
  }
  EXPECT_EQ(Decide(grasp, Radians(30)), Decision::kNo);
  EXPECT_EQ(Decide(Soft(grasp, 0.1), Radians(30)), Decision::kTooClose);
}

TEST(SoftFingersTest, BadTorsionThrows) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double torsion : {-1e-9, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)TestForceClosure(Pair(torsion), kFrame, 0.3), std::invalid_argument);
  }
  EXPECT_THROW((void)TestForceClosure(Pair(0.1), UnitFrame(2), 0.3), std::invalid_argument);
  RandomGrasps random(77);
  EXPECT_THROW((void)ForceClosureSubsets(Soft(random.OnBall(5, 3), 0.1), kFrame, 0.3),
               std::invalid_argument);
}

}  // namespace soft_fingers_test
}  // namespace regrasp::grasp
