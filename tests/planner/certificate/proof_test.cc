#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/base/number.h"
#include "planner/certificate/check_proof.h"
#include "planner/certificate/force_proof.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/planner/motion/random_boxes.h"

namespace regrasp::certificate {
namespace proof_test {

using Eigen::Vector3d;
using Kind = motion::ProofVerdict::Kind;

constexpr double kFrictionAngle = Radians(20);
const double kMu = std::tan(kFrictionAngle);

void ExpectProofsAgreeWithTheTest(int dimension, int contacts) {
  motion::RandomBoxes random(dimension);
  int proved = 0;
  int refuted = 0;
  for (int i = 0; i < 300; ++i) {
    const grasp::Grasp grasp = random.Draw(contacts);
    const grasp::ForceClosure test =
        grasp::TestForceClosure(grasp, motion::FrameOf(dimension), kFrictionAngle);
    const GraspProof proof = FindGraspProof(grasp, dimension, kFrictionAngle);
    const motion::ProofVerdict verdict = CheckGraspProof(grasp, dimension, kMu, proof);
    if (verdict.kind == Kind::kForceClosure) {
      EXPECT_EQ(test.decision, grasp::Decision::kYes);
      ++proved;
    } else if (verdict.kind == Kind::kNotForceClosure) {
      EXPECT_EQ(test.decision, grasp::Decision::kNo);
      ++refuted;
    } else {
      // For example, contacts on two parallel sides of a box are refuted only by twists on the
      // boundary of the polar cones.
      EXPECT_NE(test.decision, grasp::Decision::kYes) << verdict.why;
    }
  }
  EXPECT_GT(proved, 20) << dimension << " " << contacts;
  EXPECT_GT(refuted, 20) << dimension << " " << contacts;
  EXPECT_GT(proved + refuted, 290) << dimension << " " << contacts;
}

TEST(ProofTest, ProofsOfRandomGraspsHoldExactlyAndAgreeWithTheTest) {
  ExpectProofsAgreeWithTheTest(3, 4);
  ExpectProofsAgreeWithTheTest(3, 5);
  ExpectProofsAgreeWithTheTest(2, 3);
}

TEST(ProofTest, ProofsHoldDownToTheRequiredFrictionAndNotBelow) {
  const grasp::Grasp grasp = motion::CrossedGrasp();
  const GraspProof proof = FindGraspProof(grasp, 3, kFrictionAngle);
  ASSERT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kForceClosure);
  // Additional friction never invalidates a proof of force closure.
  EXPECT_EQ(CheckGraspProof(grasp, 3, 2 * kMu, proof).kind, Kind::kForceClosure);
  const auto required = grasp::ComputeRequiredFrictionAngle(grasp, {Vector3d::Zero(), 1, 3});
  ASSERT_TRUE(required);
  for (const double above : {1e-2, 1e-4, 1e-6}) {
    const double friction_angle = required->upper + above;
    const GraspProof near = FindGraspProof(grasp, 3, friction_angle);
    EXPECT_EQ(CheckGraspProof(grasp, 3, std::tan(friction_angle), near).kind, Kind::kForceClosure)
        << above;
    EXPECT_EQ(CheckGraspProof(grasp, 3, std::tan(required->lower - above), near).kind,
              Kind::kNothing);
    const GraspProof below = FindGraspProof(grasp, 3, required->lower - above);
    EXPECT_EQ(CheckGraspProof(grasp, 3, std::tan(required->lower - above), below).kind,
              Kind::kNotForceClosure)
        << above;
  }
}

TEST(ProofTest, ForcesThatDoNotProveAreRefused) {
  const grasp::Grasp grasp = motion::CrossedGrasp();
  const GraspProof proof = FindGraspProof(grasp, 3, kFrictionAngle);
  GraspProof wrong = proof;
  wrong.forces[2] += Vector3d(0.5, 0, 0);  // large imbalance, and therefore a large correction
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, wrong).kind, Kind::kNothing);
  wrong = proof;
  for (Vector3d& force : wrong.forces) force = -force;
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, wrong).kind, Kind::kNothing);
  wrong = proof;
  for (Vector3d& force : wrong.forces) force.setZero();
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, wrong).kind, Kind::kNothing);
  wrong = proof;
  wrong.forces.pop_back();
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, wrong).kind, Kind::kNothing);
  wrong = proof;
  wrong.forces[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, wrong).kind, Kind::kNothing);
  grasp::Grasp moved = grasp;
  moved[0].p += Vector3d(0, 0.8, 0);
  EXPECT_EQ(CheckGraspProof(moved, 3, kMu, proof).kind, Kind::kNothing);
}

TEST(ProofTest, WrittenDecimalsStillProve) {
  const grasp::Grasp grasp = motion::CrossedGrasp();
  GraspProof proof = FindGraspProof(grasp, 3, kFrictionAngle);
  for (Vector3d& force : proof.forces) force = (force * 1e6).array().round() / 1e6;
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kForceClosure);
}

TEST(ProofTest, ContactsOnOneLineProveNothing) {
  const grasp::Grasp grasp = {{Vector3d(1, 0, 0), -Vector3d::UnitX()},
                              {Vector3d(-1, 0, 0), Vector3d::UnitX()},
                              {Vector3d(-1, 0, 0), Vector3d::UnitX()}};
  GraspProof proof;
  proof.kind = GraspProof::Kind::kForces;
  proof.forces = {Vector3d(-2, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 0)};
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kNothing);
}

TEST(ProofTest, ATwistRefutesUpToTheBorderOfThePolarConeAndNotBeyond) {
  // For v = (-1, t, 0), a force (1, y, z) in the cone, |(y, z)| <= mu, does the work -1 + t y <= -1
  // + mu t.
  const grasp::Grasp grasp = {{{0, 0, 0}, {1, 0, 0}}};
  const auto sideways = [&](double t) {
    GraspProof proof;
    proof.kind = GraspProof::Kind::kTwist;
    proof.v = Vector3d(-1, t, 0);
    return CheckGraspProof(grasp, 3, 0.5, proof).kind;
  };
  EXPECT_EQ(sideways(1.99), Kind::kNotForceClosure);
  EXPECT_EQ(sideways(2), Kind::kNotForceClosure);
  EXPECT_EQ(sideways(2.001), Kind::kNothing);
}

TEST(ProofTest, TwistsThatDoNotSeparateAreRefused) {
  const grasp::Grasp grasp = motion::CrossedGrasp();
  GraspProof proof;
  proof.kind = GraspProof::Kind::kTwist;
  proof.v = Vector3d(1, 0, 0);
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kNothing);
  proof.v.setZero();
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kNothing);
  proof.kind = GraspProof::Kind::kLine;
  for (const std::array<int, 2> line : {std::array{0, 1}, {0, 2}, {0, 0}, {-1, 2}, {0, 9}}) {
    proof.line = line;
    EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kNothing);
  }
}

}  // namespace proof_test
}  // namespace regrasp::certificate
