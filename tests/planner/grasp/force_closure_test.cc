#include "planner/grasp/force_closure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "pyramid_program.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace force_closure_test {

constexpr int kSides = 64;
/// Feasibility tolerance of GLPK is 1e-7, so margins below this are not significant.
constexpr double kProgramTolerance = 1e-6;

bool PyramidForceClosure(const Grasp& grasp, int dimension, double friction_angle,
                         bool circumscribed) {
  const auto margin =
      PyramidMargin(grasp, UnitFrame(dimension), friction_angle, {kSides, circumscribed}, {});
  return margin && *margin > kProgramTolerance;
}

bool PyramidRulesOut(const Grasp& grasp, int dimension, double friction_angle) {
  const auto margin =
      PyramidMargin(grasp, UnitFrame(dimension), friction_angle, {kSides, true}, {});
  return !margin || *margin < -kProgramTolerance;
}

Decision Decide(const Grasp& grasp, int dimension, double friction_angle) {
  return TestForceClosure(grasp, UnitFrame(dimension), friction_angle).decision;
}

struct Agreement {
  int yes = 0;
  int no = 0;
  int between = 0;
};

/// Compare with both pyramids. A grasp between the two pyramids is not decided.
void Compare(const Grasp& grasp, int dimension, double friction_angle, Agreement& agreement) {
  const ForceClosure answer = TestForceClosure(grasp, UnitFrame(dimension), friction_angle);
  EXPECT_LE(answer.margin_lower, answer.margin_upper);
  if (PyramidForceClosure(grasp, dimension, friction_angle, false)) {
    EXPECT_EQ(answer.decision, Decision::kYes) << "half-angle " << Degrees(friction_angle);
    EXPECT_GT(answer.margin_lower, 0);
    ++agreement.yes;
  } else if (PyramidRulesOut(grasp, dimension, friction_angle)) {
    EXPECT_EQ(answer.decision, Decision::kNo) << "half-angle " << Degrees(friction_angle);
    EXPECT_LE(answer.margin_upper, 0);
    ++agreement.no;
  } else {
    ++agreement.between;
  }
}

TEST(ForceClosureTest, AgreesWithInscribedAndCircumscribedPyramidsInSpace) {
  RandomGrasps random(1);
  Agreement agreement;
  for (int trial = 0; trial < 2400; ++trial) {
    const int count = 3 + trial % 4;
    const double friction_angle = Radians(random.Uniform(2, 60));
    Compare(trial % 2 == 0 ? random.OnBall(count, 3) : random.OnBox(count, 3), 3, friction_angle,
            agreement);
  }
  EXPECT_GT(agreement.yes, 300);
  EXPECT_GT(agreement.no, 300);
  // Grasps between the two pyramids, and grasps in which two contacts balance alone and the margin
  // of GLPK is 0.
  EXPECT_LT(agreement.between, 40);
  RecordProperty("between", agreement.between);
}

TEST(ForceClosureTest, AgreesWithTheLinearProgramInThePlane) {
  RandomGrasps random(2);
  Agreement agreement;
  for (int trial = 0; trial < 2000; ++trial) {
    const int count = 2 + trial % 4;
    const double friction_angle = Radians(random.Uniform(2, 60));
    Compare(trial % 2 == 0 ? random.OnBall(count, 2) : random.OnBox(count, 2), 2, friction_angle,
            agreement);
  }
  EXPECT_GT(agreement.yes, 300);
  EXPECT_GT(agreement.no, 300);
  EXPECT_LT(agreement.between, 20);
}

/// Named grasps with a known answer: four fingers around the equator of a sphere, tetrahedra, …
Grasp Tetrahedron() {
  Grasp grasp;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                                        Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
    const Eigen::Vector3d p = corner.normalized();
    grasp.push_back({p, -p});
  }
  return grasp;
}

TEST(ForceClosureTest, ARegularTetrahedronIsForceClosureAtAnyFriction) {
  for (const double degrees : {0.1, 1.0, 10.0, 45.0, 89.9}) {
    EXPECT_EQ(Decide(Tetrahedron(), 3, Radians(degrees)), Decision::kYes) << degrees;
  }
}

TEST(ForceClosureTest, CollinearContactsInSpaceAreNever) {
  for (const int count : {2, 3, 4, 6}) {
    Grasp grasp;
    for (int i = 0; i < count; ++i) {
      const double x = i - 0.5 * (count - 1);
      grasp.push_back({{x, 0, 0}, Eigen::Vector3d(x < 0 ? 1 : -1, 0, 0)});
    }
    EXPECT_EQ(Decide(grasp, 3, Radians(60)), Decision::kNo) << count;
    RandomGrasps random(3);
    const Eigen::Matrix3d turn = random.Rotation(3);
    for (Contact& contact : grasp) contact = {turn * contact.p, turn * contact.n};
    EXPECT_EQ(Decide(grasp, 3, Radians(60)), Decision::kNo) << count;
  }
}

TEST(ForceClosureTest, AContactVeryFarAwayNeverMakesADefiniteNo) {
  // The other four contacts are force closure, so the answer must not be no, at any distance of the
  // fifth.
  for (const double distance : {1e5, 1e8, 1e10, 1e13, 1e16, 1e100, 1e160, 1e300}) {
    Grasp grasp = Tetrahedron();
    grasp.push_back({{distance, 0, 0}, {-1, 0, 0}});
    EXPECT_NE(Decide(grasp, 3, Radians(30)), Decision::kNo) << distance;
    // All four forces still intersect in one point, so the four contacts are force closure too.
    grasp.pop_back();
    grasp[3].p *= distance;
    EXPECT_NE(Decide(grasp, 3, Radians(30)), Decision::kNo) << distance;
  }
  // So small that squares of distances vanish.
  Grasp small = Tetrahedron();
  for (Contact& contact : small) contact.p *= 1e-200;
  EXPECT_NE(Decide(small, 3, Radians(30)), Decision::kNo);
  // Positive controls: a distance of 0.1 mm is resolved, with the answer no.
  Grasp near{{{0, 0, 0}, {1, 0, 0}},
             {{0, 1e-4, 0}, {1, 0, 0}},
             {{1, 0, 0}, {1, 0, 0}},
             {{0, 1, 0}, {1, 0, 0}}};
  EXPECT_EQ(Decide(near, 3, Radians(30)), Decision::kNo);
  near[1].p.y() = 0;  // coincident contacts count as one
  EXPECT_EQ(Decide(near, 3, Radians(30)), Decision::kNo);
}

TEST(ForceClosureTest, ThreeCollinearContactsAndOneBesideTheirLineAreNever) {
  Grasp grasp{{{-1, 0, 0}, {1, 0, 0}},
              {{0.1, 0, 0}, {0, 1, 0}},
              {{1, 0, 0}, {-1, 0, 0}},
              {{0, 1, 0.2}, {0, -0.6, 0.8}}};
  EXPECT_EQ(Decide(grasp, 3, Radians(30)), Decision::kNo);
  // Positive control: the fourth contact's cone contains the direction of the line, so that it
  // resists the rotation.
  grasp[3].n = Eigen::Vector3d(0, -1, -0.2).normalized();
  EXPECT_EQ(Decide(grasp, 3, Radians(30)), Decision::kYes);
}

TEST(ForceClosureTest, OneContactAndCoincidentContactsAreNever) {
  const Contact contact{{1, 0, 0}, {-1, 0, 0}};
  const Contact opposite{{1, 0, 0}, {1, 0, 0}};
  for (const int dimension : {2, 3}) {
    EXPECT_EQ(Decide({contact}, dimension, Radians(80)), Decision::kNo);
    EXPECT_EQ(Decide({contact, opposite, contact, opposite}, dimension, Radians(80)),
              Decision::kNo);
  }
}

TEST(ForceClosureTest, TwoBalancingContactsDoNotHelpWhereTheOthersPushTheSameWayAboutTheirLine) {
  // Fingers 0 and 1 press along x. Fingers 2 and 3 touch the top and rotate the object in the same
  // direction.
  Grasp grasp{{{-1, 0, 0}, {1, 0, 0}},
              {{1, 0, 0}, {-1, 0, 0}},
              {{-0.3, 0.8, 1}, {0, 0, -1}},
              {{0.4, 0.9, 1}, {0, 0, -1}}};
  EXPECT_EQ(Decide(grasp, 3, Radians(20)), Decision::kNo);
  // Positive control: finger 3 on the other side of the line.
  grasp[3].p.y() = -0.9;
  EXPECT_EQ(Decide(grasp, 3, Radians(20)), Decision::kYes);
  // With more friction the force of finger 2 reaches across the line.
  grasp[3].p.y() = 0.9;
  EXPECT_EQ(Decide(grasp, 3, Radians(45)), Decision::kYes);
}

TEST(ForceClosureTest, CoplanarContactsCanBeForceClosureInSpace) {
  Grasp grasp;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3;
    const Eigen::Vector3d p(std::cos(angle), std::sin(angle), 0);
    grasp.push_back({p, -p});
  }
  EXPECT_EQ(Decide(grasp, 3, Radians(5)), Decision::kYes);
  // If the normals tilt out of the plane by more than the cone, all forces have an upward
  // component.
  for (Contact& contact : grasp) {
    contact.n = (contact.n + std::tan(Radians(6)) * Eigen::Vector3d::UnitZ()).normalized();
  }
  EXPECT_EQ(Decide(grasp, 3, Radians(5)), Decision::kNo);
}

TEST(ForceClosureTest, TwoCoincidentContactsCountAsTheHullOfTheirCones) {
  Grasp grasp = Tetrahedron();
  const Contact& repeated = grasp[2];
  EXPECT_EQ(Decide({grasp[0], grasp[1], repeated, repeated}, 3, Radians(60)), Decision::kYes);
  EXPECT_EQ(Decide({grasp[0], grasp[1], repeated}, 3, Radians(60)), Decision::kYes);
  grasp.push_back(grasp.front());
  EXPECT_EQ(Decide(grasp, 3, Radians(10)), Decision::kYes);
  EXPECT_EQ(Decide({grasp[0], grasp[4], grasp[1], grasp[1]}, 3, Radians(10)), Decision::kNo);
}

TEST(ForceClosureTest, PlanarFourFingersOnASquareAreForceClosureThoughColumnsAreOpposite) {
  const Grasp square{{{-1, 0, 0}, {1, 0, 0}},
                     {{1, 0, 0}, {-1, 0, 0}},
                     {{0, -1, 0}, {0, 1, 0}},
                     {{0, 1, 0}, {0, -1, 0}}};
  for (const double degrees : {0.1, 10.0, 45.0, 80.0}) {
    EXPECT_EQ(Decide(square, 2, Radians(degrees)), Decision::kYes) << degrees;
    EXPECT_EQ(Decide(square, 3, Radians(degrees)), Decision::kYes) << degrees;
  }
}

/// Call `check` with random grasps in space and in the plane, about half of them force closure.
template <typename Check>
void ForManyGrasps(unsigned seed, Check check) {
  RandomGrasps random(seed);
  int yes = 0;
  int no = 0;
  for (int trial = 0; trial < 800; ++trial) {
    const int dimension = 2 + trial % 2;
    const int count = dimension + trial % 5;
    const double friction_angle = Radians(random.Uniform(2, 50));
    const Grasp grasp =
        trial % 3 == 0 ? random.OnBox(count, dimension) : random.OnBall(count, dimension);
    const bool holds = IsForceClosure(grasp, UnitFrame(dimension), friction_angle);
    ++(holds ? yes : no);
    check(random, grasp, dimension, friction_angle, holds);
  }
  EXPECT_GT(yes, 100);
  EXPECT_GT(no, 100);
}

TEST(ForceClosureTest, TheOrderOfTheContactsDoesNotMatter) {
  ForManyGrasps(4, [](RandomGrasps& random, Grasp grasp, int dimension, double angle, bool holds) {
    for (std::size_t i = grasp.size(); i > 1; --i) {
      std::swap(grasp[i - 1], grasp[random.Index(static_cast<int>(i))]);
    }
    EXPECT_EQ(IsForceClosure(grasp, UnitFrame(dimension), angle), holds);
  });
}

TEST(ForceClosureTest, RigidMotionAndTheUnitOfLengthDoNotMatter) {
  ForManyGrasps(5, [](RandomGrasps& random, Grasp grasp, int dimension, double angle, bool holds) {
    const double unit = std::pow(10, random.Uniform(-6, 6));
    const Eigen::Matrix3d turn = random.Rotation(dimension);
    const Eigen::Vector3d shift = 1e3 * unit * random.Direction(dimension);
    for (Contact& contact : grasp) {
      contact = {unit * (turn * contact.p) + shift, turn * contact.n};
    }
    EXPECT_EQ(IsForceClosure(grasp, {shift, unit, dimension}, angle), holds);
    EXPECT_EQ(IsForceClosure(grasp, {Eigen::Vector3d::Zero(), 1, dimension}, angle), holds);
  });
}

TEST(ForceClosureTest, MoreFrictionAndMoreContactsNeverTurnYesIntoNo) {
  ForManyGrasps(6, [](RandomGrasps& random, Grasp grasp, int dimension, double angle, bool holds) {
    if (!holds) return;
    const double more = random.Uniform(angle, Radians(89.9));
    EXPECT_TRUE(IsForceClosure(grasp, UnitFrame(dimension), more));
    grasp.push_back(random.OnBall(1, dimension).front());
    EXPECT_TRUE(IsForceClosure(grasp, UnitFrame(dimension), angle));
  });
}

TEST(ForceClosureTest, NoFamilyOfGridGraspsIsLeftUndecidedWhereItHolds) {
  // Fingers on a coarse grid of a cube: many antipodal, coplanar and collinear contacts.
  RandomGrasps random(7);
  int yes = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    Grasp grasp = random.OnBox(4, 3);
    for (Contact& contact : grasp) contact.p = (2 * contact.p).array().round() / 2;
    const double friction_angle = Radians(random.Uniform(10, 40));
    if (!PyramidForceClosure(grasp, 3, friction_angle, false)) continue;
    EXPECT_EQ(Decide(grasp, 3, friction_angle), Decision::kYes);
    ++yes;
  }
  EXPECT_GT(yes, 150);
}

TEST(ForceClosureTest, WhatIsTooCloseToCallIsNotForceClosure) {
  // Two opposite fingers; the line through them is on the boundary of both cones.
  int too_close = 0;
  for (int i = 1; i <= 50; ++i) {
    const double slope = 0.02 * i;
    const double border = std::atan(slope);
    const Grasp grasp = {{{-1, -slope, 0}, {1, 0, 0}}, {{1, slope, 0}, {-1, 0, 0}}};
    too_close += Decide(grasp, 2, border) == Decision::kTooClose ? 1 : 0;
    EXPECT_FALSE(IsForceClosure(grasp, UnitFrame(2), border)) << slope;
    EXPECT_TRUE(IsForceClosure(grasp, UnitFrame(2), border + 1e-6)) << slope;
  }
  EXPECT_GT(too_close, 0);
}

TEST(ForceClosureTest, BadArgumentsThrow) {
  const Grasp good = Tetrahedron();
  const object::WrenchFrame frame = UnitFrame(3);
  EXPECT_NO_THROW((void)TestForceClosure(good, frame, 0.3));
  for (const double angle : {0.0, -0.1, std::numbers::pi / 2, std::nan("")}) {
    EXPECT_THROW((void)TestForceClosure(good, frame, angle), std::invalid_argument) << angle;
  }
  EXPECT_THROW((void)TestForceClosure({}, frame, 0.3), std::invalid_argument);
  EXPECT_THROW((void)TestForceClosure(good, {frame.origin, 0, 3}, 0.3), std::invalid_argument);
  EXPECT_THROW((void)TestForceClosure(good, {frame.origin, 1, 4}, 0.3), std::invalid_argument);
  EXPECT_THROW((void)TestForceClosure(good, UnitFrame(2), 0.3), std::invalid_argument);
  Grasp bad = good;
  bad[1].n *= 1.01;
  EXPECT_THROW((void)TestForceClosure(bad, frame, 0.3), std::invalid_argument);
  bad = good;
  bad[2].p.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)TestForceClosure(bad, frame, 0.3), std::invalid_argument);
}

}  // namespace force_closure_test

namespace judge_grasps_test {

constexpr int kContacts = 4;
constexpr double kFrictionAngle = 0.4;
/// Number of grasps: several of the blocks that threads process.
constexpr int kGrasps = 1000;
/// Number of measured grasps, sufficient for both answers.
constexpr int kMeasured = 50;

class JudgeGraspsTest : public testing::Test {
 protected:
  JudgeGraspsTest() {
    RandomGrasps random(7);
    for (int i = 0; i < kGrasps; ++i) {
      for (const Contact& contact : random.OnBall(kContacts, 3)) {
        points_.insert(points_.end(), contact.p.data(), contact.p.data() + 3);
        normals_.insert(normals_.end(), contact.n.data(), contact.n.data() + 3);
      }
    }
  }

  [[nodiscard]] GraspVerdicts Judge(const JudgeOptions& options, int grasps = kGrasps) const {
    const std::size_t values = 3 * kContacts * static_cast<std::size_t>(grasps);
    return JudgeGrasps(
        {std::span(points_).first(values), std::span(normals_).first(values), kContacts}, options);
  }
  [[nodiscard]] Grasp GraspAt(std::size_t index) const {
    Grasp grasp;
    for (std::size_t c = index * kContacts; c < (index + 1) * kContacts; ++c) {
      grasp.push_back(
          {Eigen::Vector3d::Map(&points_[3 * c]), Eigen::Vector3d::Map(&normals_[3 * c])});
    }
    return grasp;
  }

  JudgeOptions options_{.friction_angle = kFrictionAngle, .frame = UnitFrame(3)};
  std::vector<double> points_, normals_;
};

TEST_F(JudgeGraspsTest, DecidesEachAsTheTestForOneDoes) {
  const GraspVerdicts verdicts = Judge(options_);
  ASSERT_EQ(verdicts.force_closure.size(), kGrasps);
  int yes = 0;
  for (std::size_t i = 0; i < kGrasps; ++i) {
    const ForceClosure alone = TestForceClosure(GraspAt(i), options_.frame, kFrictionAngle);
    EXPECT_EQ(verdicts.force_closure[i].decision, alone.decision) << i;
    EXPECT_EQ(verdicts.force_closure[i].margin_lower, alone.margin_lower) << i;
    EXPECT_EQ(verdicts.force_closure[i].margin_upper, alone.margin_upper) << i;
    yes += alone.decision == Decision::kYes ? 1 : 0;
  }
  EXPECT_GT(yes, kGrasps / 20);  // both answers occur
  EXPECT_LT(yes, kGrasps - kGrasps / 20);
}

TEST_F(JudgeGraspsTest, MeasuresEachAsForOne) {
  options_.required_friction_angle = options_.quality = true;
  const GraspVerdicts verdicts = Judge(options_, kMeasured);
  int held = 0;
  for (std::size_t i = 0; i < kMeasured; ++i) {
    const Grasp grasp = GraspAt(i);
    const QualityBounds quality = BoundQuality(grasp, options_.frame, kFrictionAngle);
    EXPECT_EQ(verdicts.quality[i], quality.lower) << i;
    EXPECT_EQ(verdicts.quality_upper[i], quality.upper) << i;
    EXPECT_LE(quality.upper - quality.lower, std::max(kQualityGap, 0.01 * quality.upper)) << i;
    const auto required = ComputeRequiredFrictionAngle(grasp, options_.frame);
    EXPECT_EQ(required.has_value(), !std::isnan(verdicts.required_friction_angle[i])) << i;
    if (required) {
      EXPECT_EQ(verdicts.required_friction_angle[i], required->upper) << i;
    }
    held += verdicts.quality[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(held, 0);
  EXPECT_LT(held, kMeasured);
}

TEST_F(JudgeGraspsTest, DoesNotDependOnThreads) {
  options_.threads = 1;
  const GraspVerdicts one = Judge(options_);
  options_.threads = 5;
  const GraspVerdicts five = Judge(options_);
  for (std::size_t i = 0; i < kGrasps; ++i) {
    EXPECT_EQ(one.force_closure[i].decision, five.force_closure[i].decision) << i;
    EXPECT_EQ(one.force_closure[i].margin_lower, five.force_closure[i].margin_lower) << i;
  }
}

TEST_F(JudgeGraspsTest, ComputesNothingThatIsNotAskedFor) {
  const GraspVerdicts verdicts = Judge(options_);
  EXPECT_TRUE(verdicts.required_friction_angle.empty());
  EXPECT_TRUE(verdicts.quality.empty());
  EXPECT_TRUE(verdicts.quality_upper.empty());
}

TEST_F(JudgeGraspsTest, JudgesNone) {
  EXPECT_TRUE(JudgeGrasps({{}, {}, kContacts}, options_).force_closure.empty());
}

TEST_F(JudgeGraspsTest, NamesTheFirstThatIsNone) {
  normals_[3 * kContacts * 700] = std::numeric_limits<double>::quiet_NaN();
  normals_[3 * kContacts * 12 + 4] += 0.5;
  EXPECT_THAT([&] { (void)Judge(options_); },
              testing::ThrowsMessage<std::invalid_argument>(testing::StartsWith("grasp 12: ")));
}

TEST_F(JudgeGraspsTest, RefusesArraysThatDoNotFit) {
  const std::span<const double> all(points_);
  const auto refuses = [&](GraspArrays grasps) {
    EXPECT_THROW((void)JudgeGrasps(grasps, options_), std::invalid_argument);
  };
  refuses({all.first(all.size() - 1), all.first(all.size() - 1), kContacts});
  refuses({all.first(3 * kContacts), all, kContacts});
  refuses({{}, all, kContacts});
  refuses({all, all, 0});
}

TEST_F(JudgeGraspsTest, RefusesAnglesAndThreadsOutOfRange) {
  for (const double angle : {0.0, std::numbers::pi / 2, std::nan("")}) {
    options_.friction_angle = angle;
    EXPECT_THROW((void)Judge(options_), std::invalid_argument) << angle;
  }
  options_.friction_angle = kFrictionAngle;
  options_.threads = -1;
  EXPECT_THROW((void)Judge(options_), std::invalid_argument);
}

}  // namespace judge_grasps_test
}  // namespace regrasp::grasp
