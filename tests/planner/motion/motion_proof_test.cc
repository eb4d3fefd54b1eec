#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"
#include "tests/planner/motion/random_boxes.h"

namespace regrasp::motion {
namespace motion_proof_test {

using Eigen::Vector3d;
using Kind = ProofVerdict::Kind;
using Pieces = std::vector<MotionSegment>;

constexpr double kFrictionAngle = Radians(20);
const double kMu = std::tan(kFrictionAngle);

/// Counts of verdicts on random motions.
struct Counts {
  int held = 0;
  int proved = 0;
  int lost = 0;
  int in_one_piece = 0;
};

/// Return true if all sampled instants are force closure.
bool SeemsToHold(const GraspMotion& motion, int dimension) {
  for (int k = 0; k <= 200; ++k) {
    if (!grasp::IsForceClosure(GraspAt(motion, k / 200.0), FrameOf(dimension), kFrictionAngle))
      return false;
  }
  return true;
}

/// Search for a proof of one motion, and expect that only force-closure motions are proved.
void Count(const grasp::Grasp& from, const grasp::Grasp& to, int dimension, Counts& counts) {
  const GraspMotion motion = MotionOf(from, to);
  const bool holds = SeemsToHold(motion, dimension);
  const auto pieces = FindMotionProof(motion, dimension, kFrictionAngle);
  counts.held += holds ? 1 : 0;
  counts.lost += holds ? 0 : 1;
  if (!pieces) return;
  EXPECT_TRUE(holds) << "a proof of what is not so";
  const ProofVerdict verdict = CheckMotionProof(from, to, dimension, kMu, *pieces);
  EXPECT_EQ(verdict.kind, Kind::kForceClosure) << verdict.why;
  ++counts.proved;
  counts.in_one_piece += pieces->size() == 1 ? 1 : 0;
}

void ExpectMotionsProved(int dimension, int contacts, double reach) {
  RandomBoxes random(dimension);
  Counts counts;
  for (int i = 0; i < 300; ++i) {
    const grasp::Grasp from = random.Draw(contacts);
    Count(from, random.Moved(from, reach), dimension, counts);
  }
  EXPECT_GT(counts.proved, 15);
  EXPECT_GE(counts.proved, counts.held * 97 / 100);
  EXPECT_GE(counts.in_one_piece, counts.proved / 2);
  EXPECT_GT(counts.lost, 20);
}

TEST(MotionProofTest, StraightMotionsAreProvedAllAlong) {
  ExpectMotionsProved(3, 4, 0.3);
  ExpectMotionsProved(3, 5, 0.3);
  ExpectMotionsProved(2, 3, 0.3);
  ExpectMotionsProved(2, 2, 0.3);
}

TEST(MotionProofTest, MotionsOfNoLengthAreProvedInOnePiece) {
  const grasp::Grasp grasp = CrossedGrasp();
  const auto pieces = FindMotionProof(MotionOf(grasp, grasp), 3, kFrictionAngle);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->size(), 1U);
  EXPECT_EQ(CheckMotionProof(grasp, grasp, 3, kMu, *pieces).kind, Kind::kForceClosure);
}

TEST(MotionProofTest, VeryShortMotionsAreProved) {
  const grasp::Grasp from = CrossedGrasp();
  for (const double length : {1e-3, 1e-6, 1e-9, 1e-12}) {
    grasp::Grasp to = from;
    to[0].p.y() += length;
    to[3].p.z() -= length;
    const auto pieces = FindMotionProof(MotionOf(from, to), 3, kFrictionAngle);
    ASSERT_TRUE(pieces) << length;
    EXPECT_EQ(CheckMotionProof(from, to, 3, kMu, *pieces).kind, Kind::kForceClosure) << length;
  }
}

/// Two opposite fingers with forces on the boundary of the cone, or one rounding error on either
/// side of it. Intervals cannot decide this, and rounded numbers decide it wrongly. Sizes include
/// those at which powers overflow or vanish.
TEST(MotionProofTest, ForcesAtTheBorderOfAConeAreToldExactly) {
  RandomBoxes random(2);
  constexpr std::array kSizes = {1.0, 1e-100, 1e100};
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 300; ++i) {
    const double mu = 1 + random.Uniform() / 2;
    const double normal = kSizes[i % kSizes.size()] * (1 + random.Uniform() / 2);
    const double border = mu * normal;
    for (const double tangential :
         {std::nextafter(border, 0), border, std::nextafter(border, 2 * border)}) {
      const Vector3d force(normal, tangential, 0);
      // The second contact is on the line of the first force, so that there is no torque.
      const grasp::Grasp grasp = {{Vector3d::Zero(), Vector3d::UnitX()},
                                  {force, -Vector3d::UnitX()}};
      const Pieces pieces = {{0, 1, {force, -force}, {force, -force}}};
      const bool holds = std::fma(mu, normal, -tangential) > 0;  // has the sign of the exact value
      const ProofVerdict verdict = CheckMotionProof(grasp, grasp, 2, mu, pieces);
      EXPECT_EQ(verdict.proves(), holds) << mu << " " << normal << " " << tangential;
      ++(holds ? inside : outside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

/// Return a grasp in which every normal is rotated by up to `most` radians and some contacts are
/// moved.
grasp::Grasp Turned(const grasp::Grasp& grasp, int dimension, double most, RandomBoxes& random) {
  grasp::Grasp turned = grasp;
  for (grasp::Contact& contact : turned) {
    const Vector3d axis = dimension == 3 ? contact.n.unitOrthogonal() : Vector3d::UnitZ();
    contact.n = Eigen::AngleAxisd(most * random.Uniform(), axis) * contact.n;
  }
  return turned;
}

TEST(MotionProofTest, TurningNormalsAreProvedAllAlong) {
  for (const int dimension : {2, 3}) {
    RandomBoxes random(dimension);
    Counts counts;
    for (int i = 0; i < 300; ++i) {
      const grasp::Grasp from = random.Draw(dimension + 1);
      const grasp::Grasp to = random.Moved(Turned(from, dimension, Radians(30), random), 0.1);
      Count(from, to, dimension, counts);
    }
    EXPECT_GT(counts.proved, 15) << dimension;
    EXPECT_GE(counts.proved, counts.held * 95 / 100) << dimension;
    EXPECT_GT(counts.lost, 20) << dimension;
  }
}

/// Finger that turns around the corner of a square by a right angle.
/// Every intermediate grasp is force closure at its friction.
struct Corner {
  grasp::Grasp from = {{Vector3d(1, 1, 0), -Vector3d::UnitX()},
                       {Vector3d(-1, -0.5, 0), Vector3d::UnitX()},
                       {Vector3d(-0.5, -1, 0), Vector3d::UnitY()}};
  grasp::Grasp to = from;
  double friction_angle = Radians(50);
  Corner() { to[0].n = -Vector3d::UnitY(); }
};

TEST(MotionProofTest, AFingerTurnsAroundACorner) {
  const Corner corner;
  const auto pieces = FindMotionProof(MotionOf(corner.from, corner.to), 2, corner.friction_angle);
  ASSERT_TRUE(pieces);
  const auto verdict = [&](double friction_angle, const Pieces& some) {
    return CheckMotionProof(corner.from, corner.to, 2, std::tan(friction_angle), some).kind;
  };
  EXPECT_EQ(verdict(corner.friction_angle, *pieces), Kind::kForceClosure);
  EXPECT_EQ(verdict(corner.friction_angle + Radians(10), *pieces), Kind::kForceClosure);
  // At 45° or less, no force is inside the cones of both edges.
  EXPECT_EQ(verdict(Radians(44), *pieces), Kind::kNothing);
}

TEST(MotionProofTest, ConesOfTurningNormalsAreTakenNarrower) {
  // Forces along the bisector of two edges at 45° are on the boundary of both cones.
  const Corner corner;
  const double half = std::sqrt(0.5);
  const Pieces pieces = {{0,
                          1,
                          {Vector3d(-1, -1, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)},
                          {Vector3d(-1, -1, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}}};
  grasp::Grasp from = corner.from;
  grasp::Grasp to = corner.to;
  from[1].p = to[1].p = Vector3d(-1, 1, 0);
  from[2].p = to[2].p = Vector3d(1, -1, 0);
  const auto at = [&](double beyond) {
    return CheckMotionProof(from, to, 2, std::tan(std::atan2(half, half) + beyond), pieces).kind;
  };
  EXPECT_EQ(at(10 * kTurnedNormalBound), Kind::kForceClosure);
  EXPECT_EQ(at(0.1 * kTurnedNormalBound), Kind::kNothing);
}

TEST(MotionProofTest, AForceInsideTheConeOfOneEndOnlyIsRefused) {
  const Corner corner;
  Pieces pieces = *FindMotionProof(MotionOf(corner.from, corner.to), 2, corner.friction_angle);
  // The forces balance at both ends as before, but belong to other pieces of the rotation.
  Pieces one = {pieces.front()};
  one[0].to = 1;
  const auto verdict = CheckMotionProof(corner.from, corner.to, 2, std::tan(Radians(46)), one);
  EXPECT_EQ(verdict.kind, Kind::kNothing);
  grasp::Grasp flipped = corner.to;
  flipped[0].n = Vector3d::UnitX();
  EXPECT_EQ(CheckMotionProof(corner.from, flipped, 2, kMu, pieces).kind, Kind::kNothing);
  EXPECT_FALSE(FindMotionProof(MotionOf(corner.from, flipped), 2, corner.friction_angle));
}

TEST(MotionProofTest, ForcesThatBalanceAtTheEndsOnlyAreRefused) {
  // Two pairs of fingers of a square, each of which is opposite only at one end of the motion. The
  // forces change from one pair to the other. They balance at the ends, the weak ones along the
  // line between their fingers. Between the ends both pairs rotate the square in the same
  // direction.
  const double apart = 0.4, weak = 0.1;
  const Vector3d up = Vector3d::UnitY(), below(0, -1, 0), above(0, 1, 0), x = Vector3d::UnitX();
  const grasp::Grasp from = {{below - 0.5 * x, up},
                             {above - 0.5 * x, -up},
                             {below + 0.5 * x, up},
                             {above + (0.5 + apart) * x, -up}};
  grasp::Grasp to = from;
  to[1].p += apart * x;
  to[3].p -= apart * x;
  const Vector3d slanted = weak * (up + apart / 2 * x);
  MotionSegment piece{0, 1, {up, -up, slanted, -slanted}, {slanted, -slanted, up, -up}};
  EXPECT_EQ(CheckMotionProof(from, to, 2, kMu, Pieces{piece}).kind, Kind::kNothing);
  // Positive control: as static grasps at either end the forces are a proof.
  MotionSegment start = piece;
  start.end = start.start;
  EXPECT_EQ(CheckMotionProof(from, from, 2, kMu, Pieces{start}).kind, Kind::kForceClosure);
  MotionSegment end = piece;
  end.start = end.end;
  EXPECT_EQ(CheckMotionProof(to, to, 2, kMu, Pieces{end}).kind, Kind::kForceClosure);
}

class PiecesTest : public testing::Test {
 protected:
  PiecesTest() {
    to[0].p.y() -= 0.1;
    to[2].p.z() += 0.1;
    pieces = *FindMotionProof(MotionOf(from, to), 3, kFrictionAngle);
  }
  [[nodiscard]] Kind Verdict(const Pieces& some) const {
    return CheckMotionProof(from, to, 3, kMu, some).kind;
  }

  grasp::Grasp from = CrossedGrasp();
  grasp::Grasp to = from;
  Pieces pieces;
};

TEST_F(PiecesTest, MustCoverTheWay) {
  EXPECT_EQ(Verdict(pieces), Kind::kForceClosure);
  EXPECT_EQ(Verdict({}), Kind::kNothing);
  Pieces wrong = pieces;
  wrong.back().to = 0.999;
  EXPECT_EQ(Verdict(wrong), Kind::kNothing);
  wrong.push_back(wrong.back());
  wrong.back().from = 0.9990001;
  wrong.back().to = 1;
  EXPECT_EQ(Verdict(wrong), Kind::kNothing) << "a gap";
  wrong = pieces;
  wrong.front().from = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Verdict(wrong), Kind::kNothing);
  wrong = pieces;
  wrong.push_back(wrong.back());
  EXPECT_EQ(Verdict(wrong), Kind::kNothing) << "beyond the end";
}

TEST_F(PiecesTest, ForcesMustFit) {
  Pieces wrong = pieces;
  wrong.front().start[1] *= 2;
  EXPECT_EQ(Verdict(wrong), Kind::kNothing);
  wrong = pieces;
  wrong.front().end.pop_back();
  EXPECT_EQ(Verdict(wrong), Kind::kNothing);
  wrong = pieces;
  wrong.front().end[2].z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Verdict(wrong), Kind::kNothing);
}

TEST_F(PiecesTest, BelongToOneMotion) {
  grasp::Grasp farther = to;
  farther[0].p.y() += 3;
  EXPECT_EQ(CheckMotionProof(from, farther, 3, kMu, pieces).kind, Kind::kNothing);
  grasp::Grasp turned = to;
  turned[0].n = Vector3d(-1, 0.6, 0).normalized();
  EXPECT_EQ(CheckMotionProof(from, turned, 3, kMu, pieces).kind, Kind::kNothing);
  grasp::Grasp fewer = to;
  fewer.pop_back();
  EXPECT_EQ(CheckMotionProof(from, fewer, 3, kMu, pieces).kind, Kind::kNothing);
  EXPECT_EQ(CheckMotionProof(from, to, 3, kMu / 10, pieces).kind, Kind::kNothing);
}

TEST_F(PiecesTest, WrittenAsShortDecimalsStillProve) {
  for (MotionSegment& piece : pieces) {
    for (auto* forces : {&piece.start, &piece.end}) {
      for (Vector3d& force : *forces) force = (force * 1e6).array().round() / 1e6;
    }
  }
  EXPECT_EQ(Verdict(pieces), Kind::kForceClosure);
}

}  // namespace motion_proof_test
}  // namespace regrasp::motion
