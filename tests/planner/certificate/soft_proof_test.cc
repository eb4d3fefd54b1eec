// Proofs of grasps with soft-finger contacts: torques in addition to forces, and twists with spin.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/base/number.h"
#include "planner/certificate/check_proof.h"
#include "planner/certificate/force_proof.h"
#include "planner/grasp/force_closure.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::certificate {
namespace soft_proof_test {

using Eigen::Vector3d;
using Kind = motion::ProofVerdict::Kind;

constexpr double kFrictionAngle = Radians(25);

grasp::Grasp Soft(grasp::Grasp grasp, double torsion) {
  for (grasp::Contact& contact : grasp) contact.torsion = torsion;
  return grasp;
}

grasp::Grasp Pair(double torsion) {
  return Soft({{{-1, 0, 0}, {1, 0, 0}}, {{1, 0.3, 0}, {-1, 0, 0}}}, torsion);
}

Kind Check(const grasp::Grasp& grasp, const GraspProof& proof,
           double friction_angle = kFrictionAngle) {
  return CheckGraspProof(grasp, 3, std::tan(friction_angle), proof).kind;
}

TEST(SoftProofTest, APairIsProvedAndTheSameForcesOfHardPointsAreNoProof) {
  const GraspProof proof = FindGraspProof(Pair(0.2), 3, kFrictionAngle);
  ASSERT_EQ(proof.kind, GraspProof::Kind::kForces);
  EXPECT_EQ(proof.torques.size(), 2U);
  EXPECT_EQ(Check(Pair(0.2), proof), Kind::kForceClosure);
  EXPECT_EQ(Check(Pair(0.2), proof, Radians(8)), Kind::kNothing);
  EXPECT_EQ(Check(Pair(0), proof), Kind::kNothing);
  GraspProof without = proof;
  without.torques.clear();
  EXPECT_EQ(Check(Pair(0), without), Kind::kNothing);
  // Point contacts are refuted by a rotation about their line. This does not refute soft-finger
  // contacts.
  const GraspProof refuted = FindGraspProof(Pair(0), 3, kFrictionAngle);
  EXPECT_EQ(Check(Pair(0), refuted), Kind::kNotForceClosure);
  EXPECT_EQ(Check(Pair(0.2), refuted), Kind::kNothing);
}

TEST(SoftProofTest, TorquesOnTheBorderOfTheConesAreNoProof) {
  const grasp::Grasp grasp = Soft({{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}}, 0.2);
  const auto with_torque = [&](double share) {
    GraspProof proof;
    proof.kind = GraspProof::Kind::kForces;
    proof.forces = {{1, 0, 0}, {-1, 0, 0}};
    // Torques about opposite normals are balanced.
    proof.torques = {share * 0.2 * 0.5, share * 0.2 * 0.5};
    return CheckGraspProof(grasp, 3, 0.5, proof).kind;
  };
  EXPECT_EQ(with_torque(0.999), Kind::kForceClosure);
  EXPECT_EQ(with_torque(1), Kind::kNothing);
  EXPECT_EQ(with_torque(-1.001), Kind::kNothing);
}

TEST(SoftProofTest, ATwistThatSpinsRefutesUpToTheBorderOfThePolarConeAndNotBeyond) {
  // For v = (-1, 0, 0) and a spin s, a unit normal force with its largest torque, mu times the
  // torsion, does the work -1 + mu 0.25 s.
  const auto spinning = [](double s) {
    GraspProof proof;
    proof.kind = GraspProof::Kind::kTwist;
    proof.v = Vector3d(-1, 0, 0);
    proof.omega = Vector3d(s, 0, 0);
    return CheckGraspProof(Soft({{{0, 0, 0}, {1, 0, 0}}}, 0.25), 3, 0.5, proof).kind;
  };
  for (const double sign : {1, -1}) {
    EXPECT_EQ(spinning(sign * 7.99), Kind::kNotForceClosure);
    EXPECT_EQ(spinning(sign * 8), Kind::kNotForceClosure);
    EXPECT_EQ(spinning(sign * 8.001), Kind::kNothing);
  }
}

TEST(SoftProofTest, ProofsThatAreChangedProveNothing) {
  const GraspProof proof = FindGraspProof(Pair(0.2), 3, kFrictionAngle);
  const auto expect_nothing = [&](auto change) {
    GraspProof changed = proof;
    change(changed);
    EXPECT_EQ(Check(Pair(0.2), changed), Kind::kNothing);
  };
  expect_nothing([](GraspProof& p) { p.torques.pop_back(); });
  expect_nothing([](GraspProof& p) { p.torques[0] = std::nan(""); });
  expect_nothing([](GraspProof& p) { p.torques = {1, 1}; });
  // All forces are negated, because the exact correction could compensate for a single one.
  expect_nothing([](GraspProof& p) {
    for (Vector3d& force : p.forces) force = -force;
  });
}

TEST(SoftProofTest, EveryClearAnswerHasAProofThatHolds) {
  RandomGrasps random(91);
  int proved = 0, refuted = 0, without = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 2 + trial % 4;
    const grasp::Grasp grasp =
        Soft(trial % 2 == 0 ? random.OnBall(count, 3) : random.OnBox(count, 3),
             std::pow(10, random.Uniform(-2, 0)));
    const double friction_angle = Radians(random.Uniform(10, 50));
    const auto decision = grasp::TestForceClosure(grasp, UnitFrame(3), friction_angle).decision;
    const Kind kind = Check(grasp, FindGraspProof(grasp, 3, friction_angle), friction_angle);
    if (kind == Kind::kForceClosure) {
      EXPECT_EQ(decision, grasp::Decision::kYes) << trial;
    } else if (kind == Kind::kNotForceClosure) {
      EXPECT_EQ(decision, grasp::Decision::kNo) << trial;
    }
    proved += kind == Kind::kForceClosure;
    refuted += kind == Kind::kNotForceClosure;
    without += kind == Kind::kNothing;
  }
  EXPECT_GT(proved, 60);
  EXPECT_GT(refuted, 60);
  EXPECT_LT(without, 6);
}

}  // namespace soft_proof_test
}  // namespace regrasp::certificate
