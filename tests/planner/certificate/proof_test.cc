#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/base/angle.h"
#include "planner/certificate/check_proof.h"
#include "planner/certificate/find_motion_proof.h"
#include "planner/certificate/find_proof.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/plan/path_force_closure.h"

namespace regrasp {
namespace {

using Eigen::Vector3d;
using Kind = ProofVerdict::Kind;

constexpr double kHalfAngle = Radians(20);
const double kMu = std::tan(kHalfAngle);

/// Random grasps of a box away from the origin; planar ones of a square.
class RandomBoxes {
 public:
  explicit RandomBoxes(int dimension) : dimension_(dimension) {}

  Grasp Draw(int count) {
    Grasp grasp;
    for (int i = 0; i < count; ++i) grasp.push_back(DrawContact());
    return grasp;
  }
  Contact DrawContact() {
    Contact contact;
    for (int axis = 0; axis < dimension_; ++axis) contact.p[axis] = uniform_(engine_);
    const int axis = std::uniform_int_distribution<int>(0, dimension_ - 1)(engine_);
    const double side = uniform_(engine_) < 0 ? -1 : 1;
    contact.p[axis] = side;
    contact.n[axis] = -side;
    contact.p += dimension_ == 3 ? Vector3d(5, -3, 2) : Vector3d(5, -3, 0);
    return contact;
  }
  /// Elsewhere on the same sides.
  Grasp Moved(const Grasp& grasp, double reach) {
    Grasp moved = grasp;
    for (Contact& contact : moved) {
      for (int axis = 0; axis < dimension_; ++axis) {
        if (contact.n[axis] == 0) contact.p[axis] += reach * uniform_(engine_);
      }
    }
    return moved;
  }

 private:
  int dimension_;
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

WrenchFrame FrameOf(int dimension) { return {Vector3d(5, -3, 0), 1.5, dimension}; }

void ExpectProofsAgreeWithTheTest(int dimension, int contacts) {
  RandomBoxes random(dimension);
  int proved = 0;
  int refuted = 0;
  for (int i = 0; i < 300; ++i) {
    const Grasp grasp = random.Draw(contacts);
    const ForceClosure test = TestForceClosure(grasp, FrameOf(dimension), kHalfAngle);
    const GraspProof proof = FindGraspProof(grasp, dimension, kHalfAngle);
    const ProofVerdict verdict = CheckGraspProof(grasp, dimension, kMu, proof);
    if (verdict.kind == Kind::kForceClosure) {
      EXPECT_EQ(test.decision, Decision::kYes);
      ++proved;
    } else if (verdict.kind == Kind::kNotForceClosure) {
      EXPECT_EQ(test.decision, Decision::kNo);
      ++refuted;
    } else {
      // Contacts on two parallel sides of a box, say, that only a line of touching twists refutes.
      EXPECT_NE(test.decision, Decision::kYes) << verdict.why;
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

/// Two pairs of opposite fingers on the sides of a cube.
Grasp CrossedGrasp() {
  return {{Vector3d(1, 0.1, 0), -Vector3d::UnitX()},
          {Vector3d(-1, 0, 0.1), Vector3d::UnitX()},
          {Vector3d(0, 1, -0.1), -Vector3d::UnitY()},
          {Vector3d(0.1, -1, 0), Vector3d::UnitY()}};
}

TEST(ProofTest, ProofsHoldDownToTheRequiredFrictionAndNotBelow) {
  const Grasp grasp = CrossedGrasp();
  const GraspProof proof = FindGraspProof(grasp, 3, kHalfAngle);
  ASSERT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kForceClosure);
  // More friction never takes a proof away.
  EXPECT_EQ(CheckGraspProof(grasp, 3, 2 * kMu, proof).kind, Kind::kForceClosure);
  const auto required = ComputeRequiredHalfAngle(grasp, {Vector3d::Zero(), 1, 3});
  ASSERT_TRUE(required);
  for (const double above : {1e-2, 1e-4, 1e-6}) {
    const double half_angle = required->upper + above;
    const GraspProof near = FindGraspProof(grasp, 3, half_angle);
    EXPECT_EQ(CheckGraspProof(grasp, 3, std::tan(half_angle), near).kind, Kind::kForceClosure)
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
  const Grasp grasp = CrossedGrasp();
  const GraspProof proof = FindGraspProof(grasp, 3, kHalfAngle);
  GraspProof wrong = proof;
  wrong.forces[2] += Vector3d(0.5, 0, 0);  // out of balance by much: so is what makes up for it
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
  Grasp moved = grasp;
  moved[0].p += Vector3d(0, 0.8, 0);
  EXPECT_EQ(CheckGraspProof(moved, 3, kMu, proof).kind, Kind::kNothing);
}

TEST(ProofTest, WrittenDecimalsStillProve) {
  const Grasp grasp = CrossedGrasp();
  GraspProof proof = FindGraspProof(grasp, 3, kHalfAngle);
  for (Vector3d& force : proof.forces) force = (force * 1e6).array().round() / 1e6;
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kForceClosure);
}

TEST(ProofTest, ContactsOnOneLineProveNothing) {
  const Grasp grasp = {{Vector3d(1, 0, 0), -Vector3d::UnitX()},
                       {Vector3d(-1, 0, 0), Vector3d::UnitX()},
                       {Vector3d(-1, 0, 0), Vector3d::UnitX()}};
  GraspProof proof;
  proof.kind = GraspProof::Kind::kForces;
  proof.forces = {Vector3d(-2, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 0)};
  EXPECT_EQ(CheckGraspProof(grasp, 3, kMu, proof).kind, Kind::kNothing);
}

TEST(ProofTest, TwistsThatDoNotSeparateAreRefused) {
  const Grasp grasp = CrossedGrasp();
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

GraspMotion MotionOf(const Grasp& from, const Grasp& to) {
  GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return motion;
}

void ExpectMotionsProved(int dimension, int contacts, double reach) {
  RandomBoxes random(dimension);
  int held = 0;
  int proved = 0;
  int lost = 0;
  for (int i = 0; i < 150; ++i) {
    const Grasp from = random.Draw(contacts);
    const Grasp to = random.Moved(from, reach);
    const GraspMotion motion = MotionOf(from, to);
    const bool holds = DecidePathForceClosure(motion, FrameOf(dimension), kHalfAngle).holds;
    const auto pieces = FindMotionProof(motion, dimension, kHalfAngle);
    held += holds ? 1 : 0;
    if (!pieces) {
      lost += holds ? 0 : 1;
      continue;
    }
    const ProofVerdict verdict = CheckMotionProof(from, to, dimension, kMu, *pieces);
    EXPECT_EQ(verdict.kind, Kind::kForceClosure) << verdict.why;
    EXPECT_TRUE(holds) << "a proof of what is not so";
    ++proved;
  }
  EXPECT_GT(proved, 10);
  EXPECT_GE(proved, held * 9 / 10);
  EXPECT_GT(lost, 10);
}

TEST(ProofTest, StraightMotionsAreProvedAllAlong) {
  ExpectMotionsProved(3, 4, 0.3);
  ExpectMotionsProved(3, 5, 0.3);
  ExpectMotionsProved(2, 3, 0.3);
}

TEST(ProofTest, MotionPiecesMustCoverTheWayAndFit) {
  const Grasp from = CrossedGrasp();
  Grasp to = from;
  to[0].p.y() -= 0.1;
  to[2].p.z() += 0.1;
  const auto pieces = FindMotionProof(MotionOf(from, to), 3, kHalfAngle);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(CheckMotionProof(from, to, 3, kMu, *pieces).kind, Kind::kForceClosure);
  EXPECT_EQ(CheckMotionProof(from, to, 3, kMu, {}).kind, Kind::kNothing);
  auto wrong = *pieces;
  wrong.back().to = 0.999;
  EXPECT_EQ(CheckMotionProof(from, to, 3, kMu, wrong).kind, Kind::kNothing);
  wrong = *pieces;
  wrong.front().start[1] *= 2;
  EXPECT_EQ(CheckMotionProof(from, to, 3, kMu, wrong).kind, Kind::kNothing);
  Grasp farther = to;
  farther[0].p.y() += 3;
  EXPECT_EQ(CheckMotionProof(from, farther, 3, kMu, *pieces).kind, Kind::kNothing);
  Grasp turned = to;
  turned[0].n = Vector3d(-1, 0.1, 0).normalized();
  EXPECT_EQ(CheckMotionProof(from, turned, 3, kMu, *pieces).kind, Kind::kNothing);
  EXPECT_FALSE(FindMotionProof(MotionOf(from, turned), 3, kHalfAngle));
}

}  // namespace
}  // namespace regrasp
