// Motions of soft fingers: the proofs by their torques, and the limits of these proofs.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/motion/path_force_closure.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::motion {
namespace soft_motion_test {

using Eigen::Vector3d;

constexpr double kFrictionAngle = Radians(25);

/// Return contacts on the faces x = ±1 of a cube.
grasp::Grasp Pair(const Vector3d& left, const Vector3d& right, double torsion) {
  return {{{-1, left.y(), left.z()}, {1, 0, 0}, {}, torsion},
          {{1, right.y(), right.z()}, {-1, 0, 0}, {}, torsion}};
}

GraspMotion Between(const grasp::Grasp& from, const grasp::Grasp& to) {
  GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return motion;
}

/// Pair that slides across its faces, one finger before the other.
struct Slide {
  explicit Slide(double torsion)
      : from(Pair({0, 0, 0}, {0, 0.2, 0}, torsion)),
        to(Pair({0, 0.3, 0.6}, {0, 0.1, 0.5}, torsion)),
        motion(Between(from, to)) {}

  [[nodiscard]] ProofVerdict Check(const MotionSegments& pieces) const {
    return CheckMotionProof(from, to, 3, std::tan(kFrictionAngle), pieces);
  }

  grasp::Grasp from;
  grasp::Grasp to;
  GraspMotion motion;
};

TEST(SoftMotionTest, APairThatSlidesIsProvedAndOfHardPointsNothingIs) {
  for (const double torsion : {0.01, 0.2, 5.0}) {
    const Slide soft(torsion);
    const auto proof = FindMotionProof(soft.motion, 3, kFrictionAngle);
    ASSERT_TRUE(proof) << torsion;
    const ProofVerdict verdict = soft.Check(*proof);
    EXPECT_TRUE(verdict.proves()) << verdict.why;
    EXPECT_TRUE(DecidePathForceClosure(soft.motion, UnitFrame(3), kFrictionAngle).holds());
  }
  const Slide hard(0);
  EXPECT_FALSE(FindMotionProof(hard.motion, 3, kFrictionAngle));
  EXPECT_EQ(DecidePathForceClosure(hard.motion, UnitFrame(3), kFrictionAngle).decision,
            grasp::Decision::kNo);
}

TEST(SoftMotionTest, ItsRequiredFrictionAngleIsTheLargestOffset) {
  // For opposite normals the required angle is that between them and the line of the contacts. It
  // is largest at an end, because the offset of the contacts is convex in t.
  const Slide slide(0.2);
  const auto required = ComputePathRequiredFrictionAngle(slide.motion, UnitFrame(3), std::nullopt);
  ASSERT_TRUE(required);
  EXPECT_NEAR(required->lower, std::atan(std::hypot(0.2, 0.1) / 2), 1e-5);
  EXPECT_LE(required->upper, required->lower + 2 * kPathAngleAccuracy);
}

TEST(SoftMotionTest, AProofThatIsChangedIsNone) {
  const Slide slide(0.2);
  const auto proof = FindMotionProof(slide.motion, 3, kFrictionAngle);
  ASSERT_TRUE(proof);
  ASSERT_TRUE(slide.Check(*proof).proves());
  const auto expect_nothing = [&](auto change) {
    MotionSegments changed = *proof;
    change(changed.front());
    EXPECT_FALSE(slide.Check(changed).proves());
  };
  // A small change is compensated by the margins of the other forces.
  expect_nothing([](MotionSegment& piece) { piece.start_torques[0] += 0.05; });
  expect_nothing([](MotionSegment& piece) { piece.end_torques[1] = 1; });
  expect_nothing([](MotionSegment& piece) { piece.end_torques.pop_back(); });
  expect_nothing([](MotionSegment& piece) {
    piece.start_torques[1] = std::numeric_limits<double>::infinity();
  });
  expect_nothing([](MotionSegment& piece) { piece.start[0].y() += 0.2; });
  // The same forces with hard contacts.
  grasp::Grasp from = slide.from, to = slide.to;
  for (grasp::Contact& contact : from) contact.torsion = 0;
  EXPECT_FALSE(CheckMotionProof(from, to, 3, std::tan(kFrictionAngle), *proof).proves());
  // With less friction than was proved, the offset of 0.2 requires 5.7°.
  EXPECT_FALSE(CheckMotionProof(slide.from, slide.to, 3, std::tan(Radians(5)), *proof).proves());
}

TEST(SoftMotionTest, TorquesBeyondTheTorsionProveNothing) {
  // Two torques of opposite normals balance, regardless of their size.
  const Slide slide(0.2);
  const auto proof = FindMotionProof(slide.motion, 3, kFrictionAngle);
  ASSERT_TRUE(proof);
  const auto with_torque = [&](double share) {
    MotionSegments changed = *proof;
    for (MotionSegment& piece : changed) {
      for (std::size_t i = 0; i < 2; ++i) {
        const double most = std::tan(kFrictionAngle) * 0.2;
        piece.start_torques[i] = share * most * std::abs(piece.start[i].x());
        piece.end_torques[i] = share * most * std::abs(piece.end[i].x());
      }
    }
    return slide.Check(changed).proves();
  };
  EXPECT_TRUE(with_torque(0.5));
  EXPECT_FALSE(with_torque(1.001));
}

TEST(SoftMotionTest, AFingerWhoseNormalTurnsIsAHardPoint) {
  const double torsion = 0.2;
  const grasp::Grasp from = Pair({0, 0, 0}, {0, 0, 0}, torsion);
  grasp::Grasp to = from;
  to[0].n = Vector3d(std::cos(0.1), std::sin(0.1), 0);
  // The other finger alone resists rotations about the line.
  const GraspMotion one = Between(from, to);
  EXPECT_TRUE(DecidePathForceClosure(one, UnitFrame(3), kFrictionAngle).holds());
  to[1].n = Vector3d(-std::cos(0.1), 0, std::sin(0.1));
  const PathForceClosure both =
      DecidePathForceClosure(Between(from, to), UnitFrame(3), kFrictionAngle);
  EXPECT_EQ(both.decision, grasp::Decision::kTooClose);
  EXPECT_TRUE(both.ended_early);
}

TEST(SoftMotionTest, WhatIsSaidToHoldHoldsAtEveryInstantAndMoreTorsionKeepsIt) {
  RandomGrasps random(81);
  int proved = 0, refuted = 0, helped = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 2 + trial % 3;
    const double torsion = std::pow(10, random.Uniform(-1.5, 0));
    grasp::Grasp from = random.OnBox(count, 3);
    grasp::Grasp to = from;
    for (std::size_t i = 0; i < from.size(); ++i) {
      from[i].torsion = to[i].torsion = torsion;
      to[i].p += 0.3 * random.Direction(3).cwiseProduct(Vector3d::Ones() - from[i].n.cwiseAbs());
    }
    const double friction_angle = Radians(random.Uniform(10, 50));
    const GraspMotion motion = Between(from, to);
    const PathForceClosure path = DecidePathForceClosure(motion, UnitFrame(3), friction_angle);
    if (path.decision == grasp::Decision::kNo) {
      EXPECT_FALSE(grasp::IsForceClosure(GraspAt(motion, path.at), UnitFrame(3), friction_angle));
      ++refuted;
    }
    if (!path.holds()) continue;
    ++proved;
    for (int k = 0; k <= 40; ++k) {
      EXPECT_TRUE(grasp::IsForceClosure(GraspAt(motion, k / 40.0), UnitFrame(3), friction_angle));
    }
    for (std::size_t i = 0; i < from.size(); ++i) from[i].torsion = to[i].torsion = 2 * torsion;
    EXPECT_TRUE(DecidePathForceClosure(Between(from, to), UnitFrame(3), friction_angle).holds());
    for (std::size_t i = 0; i < from.size(); ++i) from[i].torsion = to[i].torsion = 0;
    if (!DecidePathForceClosure(Between(from, to), UnitFrame(3), friction_angle).holds()) ++helped;
  }
  EXPECT_GT(proved, 40);
  EXPECT_GT(refuted, 40);
  EXPECT_GT(helped, 10);
}

}  // namespace soft_motion_test
}  // namespace regrasp::motion
