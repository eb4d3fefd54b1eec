#include "planner/motion/path_force_closure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"

namespace regrasp::motion {
namespace path_force_closure_test {

constexpr unsigned kSeed = 20;

/// Random motions of `count` contacts on the faces of an object: most slide, some turn at an edge.
class RandomMotions {
 public:
  /// @param turning  share of contacts that turn.
  explicit RandomMotions(int dimension, double turning = 0.2)
      : dimension_(dimension), turning_(turning) {}

  GraspMotion Next(int count) {
    GraspMotion motion;
    for (int i = 0; i < count; ++i) motion.push_back(Uniform(0, 1) < turning_ ? Turn() : Slide());
    return motion;
  }

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  int Axis() { return std::uniform_int_distribution<int>(0, dimension_ - 1)(random_); }
  double Sign() { return Uniform(-1, 1) < 0 ? -1 : 1; }

  /// Return a point of the face ±axis of the cube or square.
  grasp::Contact OnFace(int axis, double sign) {
    grasp::Contact contact;
    for (int k = 0; k < dimension_; ++k) contact.p[k] = Uniform(-1, 1);
    contact.p[axis] = sign;
    contact.n[axis] = -sign;
    return contact;
  }

  ContactMotion Slide() {
    const int axis = Axis();
    const double sign = Sign();
    const grasp::Contact from = OnFace(axis, sign);
    grasp::Contact to = OnFace(axis, sign);
    to.p = from.p + Uniform(0, 1) * (to.p - from.p);
    return {from, to};
  }

  ContactMotion Turn() {
    const int axis = Axis();
    const int other = (axis + 1) % dimension_;
    grasp::Contact from = OnFace(axis, Sign());
    grasp::Contact to = from;
    from.p[other] = to.p[other] = Sign();
    to.n.setZero();
    to.n[other] = -to.p[other];
    return {from, to};
  }

  int dimension_;
  double turning_;
  std::mt19937 random_{kSeed};
};

object::WrenchFrame FrameOf(int dimension) {
  return {Eigen::Vector3d::Zero(), std::sqrt(static_cast<double>(dimension)), dimension};
}

class PathForceClosureIn : public testing::TestWithParam<int> {
 protected:
  int dimension() const { return GetParam(); }
  object::WrenchFrame frame() const { return FrameOf(dimension()); }
  bool HoldsAt(const GraspMotion& motion, double t, double friction_angle) const {
    return grasp::IsForceClosure(GraspAt(motion, t), frame(), friction_angle);
  }
};

/// Return true if a piece of a motion is proved, by a proof that exact arithmetic accepts.
bool IsProved(const GraspMotion& motion, int dimension, double friction_angle, double from,
              double to) {
  const auto proof = FindSegmentProof(motion, dimension, friction_angle, from, to);
  if (!proof) return false;
  EXPECT_EQ(proof->from, from);
  EXPECT_EQ(proof->to, to);
  const grasp::Grasp start = GraspAt(motion, 0), end = GraspAt(motion, 1);
  return CheckSegmentProof(start, end, dimension, std::tan(friction_angle), *proof).proves();
}

/// Return the largest proved interval around the middle of a motion, with a resolution of 1/4000; 0
/// if none.
double LargestReach(const GraspMotion& motion, int dimension, double friction_angle) {
  double proved = 0, open = 0.5;
  for (int step = 0; step < 12; ++step) {
    const double reach = (proved + open) / 2;
    const bool proof = IsProved(motion, dimension, friction_angle, 0.5 - reach, 0.5 + reach);
    (proof ? proved : open) = reach;
  }
  return proved;
}

TEST_P(PathForceClosureIn, ProvesOnlyWhatDenseSamplingConfirms) {
  RandomMotions motions(dimension());
  int proved = 0, samples = 0;
  for (int i = 0; i < 1000; ++i) {
    const GraspMotion motion = motions.Next(dimension() + i % 3);
    // Close to the limit, at which an incorrect proof would be detected.
    const auto required = grasp::ComputeRequiredFrictionAngle(GraspAt(motion, 0.5), frame(), 1e-6);
    if (!required) continue;
    const double friction_angle = required->upper + std::pow(10, motions.Uniform(-4, -0.5));
    if (!(friction_angle < Radians(85))) continue;
    const double reach = LargestReach(motion, dimension(), friction_angle);
    if (!(reach > 0)) continue;
    ++proved;
    for (int k = -5; k <= 5; ++k) {
      EXPECT_TRUE(HoldsAt(motion, 0.5 + reach * k / 5, friction_angle)) << i << " at " << k;
      ++samples;
    }
  }
  EXPECT_GT(proved, 250);
  EXPECT_EQ(samples, 11 * proved);
}

TEST_P(PathForceClosureIn, AgreesWithDenseSampling) {
  RandomMotions motions(dimension());
  int held = 0, lost = 0, undecided = 0;
  for (int i = 0; i < 400; ++i) {
    const GraspMotion motion = motions.Next(dimension() + 1 + i % 2);
    const double friction_angle = Radians(motions.Uniform(15, 70));
    const PathForceClosure path = DecidePathForceClosure(motion, frame(), friction_angle);
    undecided += path.undecided;
    if (path.holds()) {
      ++held;
      for (int k = 0; k <= 200; ++k) {
        EXPECT_TRUE(HoldsAt(motion, k / 200.0, friction_angle)) << i << " at " << k;
      }
    } else {
      ++lost;
      EXPECT_FALSE(HoldsAt(motion, path.at, friction_angle)) << i;
    }
  }
  EXPECT_GT(held, 40);
  EXPECT_GT(lost, 40);
  EXPECT_EQ(undecided, 0);
}

TEST_P(PathForceClosureIn, BoundsTheRequiredFrictionAngleOfTheWholeWay) {
  RandomMotions motions(dimension());
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const GraspMotion motion = motions.Next(dimension() + 2);
    const auto bounds = ComputePathRequiredFrictionAngle(motion, frame(), std::nullopt);
    double largest = 0;
    bool none = false;
    for (int k = 0; k <= 100; ++k) {
      const auto there =
          grasp::ComputeRequiredFrictionAngle(GraspAt(motion, k / 100.0), frame(), 1e-7);
      none = none || !there;
      if (there) largest = std::max(largest, there->lower);
    }
    if (!bounds) continue;
    ++checked;
    EXPECT_FALSE(none);
    EXPECT_LE(bounds->lower, bounds->upper);
    EXPECT_LE(largest, bounds->upper);
    EXPECT_TRUE(DecidePathForceClosure(motion, frame(), bounds->upper).holds());
    if (bounds->lower > kPathAngleAccuracy) {
      EXPECT_FALSE(
          DecidePathForceClosure(motion, frame(), bounds->lower - kPathAngleAccuracy).holds());
    }
  }
  RecordProperty("checked", checked);
  EXPECT_GT(checked, 20);
}

/// Number of random motions with a required friction angle, and of those with the specified
/// accuracy of the bounds.
struct Accuracy {
  int bounded = 0;
  int accurate = 0;
};

Accuracy CountAccurate(RandomMotions motions, int contacts, const object::WrenchFrame& frame) {
  Accuracy count;
  for (int i = 0; i < 60; ++i) {
    const GraspMotion motion = motions.Next(contacts);
    const auto bounds = ComputePathRequiredFrictionAngle(motion, frame, std::nullopt);
    if (!bounds) continue;
    ++count.bounded;
    if (bounds->upper - bounds->lower <= 1.1 * kPathAngleAccuracy) ++count.accurate;
  }
  return count;
}

TEST_P(PathForceClosureIn, BoundsAreNearlyAlwaysAsNearAsPromised) {
  const int contacts = dimension() + 2;
  const Accuracy slides = CountAccurate(RandomMotions(dimension(), 0), contacts, frame());
  EXPECT_GT(slides.bounded, 20);
  EXPECT_GE(slides.accurate, slides.bounded * 95 / 100);
  // If normals rotate, proofs must keep forces inside the cones of both ends of a piece.
  const Accuracy turns = CountAccurate(RandomMotions(dimension(), 0.2), contacts, frame());
  EXPECT_GT(turns.bounded, 20);
  EXPECT_GE(turns.accurate, turns.bounded * 80 / 100);
}

TEST(PathForceClosure, BoundsAnAlignThatWeakerProofsBoundByTheFrictionItWasPlannedWith) {
  const auto contact = [](double x, double y, double z, const Eigen::Vector3d& n) {
    return grasp::Contact{{x, y, z}, n};
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const grasp::Contact third = contact(-0.03, -0.028, 0.025, x),
                       fourth = contact(0.03, -0.0275, 0.026, -x);
  const GraspMotion motion = {
      {contact(-0.03, -0.0155, -0.0255, x), contact(-0.03, 0.0063, 0.0296, x)},
      {contact(-0.0152, 0.03, -0.014, -y), contact(0.0003, 0.03, -0.0229, -y)},
      {third, third},
      {fourth, fourth}};
  const auto bounds = ComputePathRequiredFrictionAngle(motion, FrameOf(3), Radians(25));
  ASSERT_TRUE(bounds);
  EXPECT_GT(bounds->lower, Radians(0.1));
  EXPECT_LT(bounds->upper - bounds->lower, Radians(0.1));
}

/// Peak of the required friction angle strictly inside a motion, found by sampling and refinement.
struct Peak {
  double at = 0;
  double angle = 0;
};

std::optional<Peak> FindInnerPeak(const GraspMotion& motion, const object::WrenchFrame& frame) {
  const auto angle_at = [&](double t) {
    const auto required = grasp::ComputeRequiredFrictionAngle(GraspAt(motion, t), frame, 1e-12);
    return required ? required->upper : 2.0;
  };
  constexpr int kSamples = 24;
  Peak peak;
  int best = 0;
  for (int k = 0; k <= kSamples; ++k) {
    const double angle = angle_at(static_cast<double>(k) / kSamples);
    if (angle > peak.angle) {
      peak.angle = angle;
      best = k;
    }
  }
  if (best == 0 || best == kSamples || peak.angle > Radians(85)) return std::nullopt;
  double from = static_cast<double>(best - 1) / kSamples;
  double to = static_cast<double>(best + 1) / kSamples;
  while (to - from > 1e-7) {  // ternary search; its accuracy is verified by the uses
    const double left = from + (to - from) / 3, right = to - (to - from) / 3;
    (angle_at(left) < angle_at(right) ? from : to) =
        angle_at(left) < angle_at(right) ? left : right;
  }
  peak.at = (from + to) / 2;
  peak.angle = angle_at(peak.at);
  return peak;
}

TEST_P(PathForceClosureIn, CatchesForceClosureLostForATenThousandthOfTheWay) {
  RandomMotions motions(dimension());
  int narrow = 0, held = 0, undecided = 0;
  for (int i = 0; i < 600 && narrow < 12; ++i) {
    const GraspMotion motion = motions.Next(dimension() + 2);
    const std::optional<Peak> peak = FindInnerPeak(motion, frame());
    if (!peak) continue;
    // Friction slightly too low at 5e-5 on either side of the peak.
    const auto before =
        grasp::ComputeRequiredFrictionAngle(GraspAt(motion, peak->at - 5e-5), frame(), 1e-12);
    const auto after =
        grasp::ComputeRequiredFrictionAngle(GraspAt(motion, peak->at + 5e-5), frame(), 1e-12);
    if (!before || !after) continue;
    const double friction_angle = std::max(before->upper, after->upper) + 1e-11;
    if (!(friction_angle < peak->angle - 1e-9)) continue;
    ++narrow;
    EXPECT_TRUE(HoldsAt(motion, 0, friction_angle));
    EXPECT_TRUE(HoldsAt(motion, peak->at - 6e-5, friction_angle));
    EXPECT_TRUE(HoldsAt(motion, peak->at + 6e-5, friction_angle));
    EXPECT_TRUE(HoldsAt(motion, 1, friction_angle));
    const PathForceClosure path = DecidePathForceClosure(motion, frame(), friction_angle);
    EXPECT_EQ(path.decision, grasp::Decision::kNo) << i;
    EXPECT_NEAR(path.at, peak->at, 6e-5);
    if (DecidePathForceClosure(motion, frame(), peak->angle + kPathAngleAccuracy).holds()) ++held;
    // The true peak is at least as high as the found one, so that force closure is lost only for an
    // instant.
    for (const double loss : {1e-7, 1e-10}) {
      const PathForceClosure close = DecidePathForceClosure(motion, frame(), peak->angle - loss);
      EXPECT_FALSE(close.holds()) << i << ", " << loss;
      if (close.decision != grasp::Decision::kTooClose) continue;
      ++undecided;
      EXPECT_GT(close.undecided, 0);
      EXPECT_NEAR(close.at, peak->at, 1e-3);
    }
  }
  RecordProperty("narrow", narrow);
  EXPECT_GE(narrow, 6);
  EXPECT_EQ(held, narrow);
  EXPECT_GT(undecided, 0);
}

TEST(PathForceClosure, RefusesAMotionThatKeepsTooCloseToTheLimit) {
  // Finger 1 moves along x = 1, and finger 0's normal rotates uniformly with the direction to it.
  // The angle between them is 0.3 + atan t − t, which is within 1e-9 of its maximum for the first
  // thousandth.
  const auto contact = [](double x, double y, double angle) {
    return grasp::Contact{{x, y, 0}, {std::cos(angle), std::sin(angle), 0}};
  };
  const double pi = Radians(180);
  const GraspMotion motion = {{contact(0, 0, -0.3), contact(0, 0, 0.7)},
                              {contact(1, 0, pi), contact(1, 1, pi + pi / 4)}};
  const double close = 0.3 + 1e-9;
  int sampled = 0;
  for (int k = 0; k <= 1000; ++k, ++sampled) {
    EXPECT_TRUE(grasp::IsForceClosure(GraspAt(motion, k / 1000.0), FrameOf(2), close));
  }
  EXPECT_EQ(sampled, 1001);
  const PathForceClosure refused = DecidePathForceClosure(motion, FrameOf(2), close);
  EXPECT_EQ(refused.decision, grasp::Decision::kTooClose);
  EXPECT_TRUE(refused.ended_early);
  EXPECT_EQ(refused.undecided, kMostUndecided + 1);
  const PathForceClosure control = DecidePathForceClosure(motion, FrameOf(2), 0.3 + 1e-4);
  EXPECT_TRUE(control.holds());
  EXPECT_EQ(control.undecided, 0);
}

TEST(PathForceClosure, EndsWhereTheBudgetOfAllMotionsIsSpent) {
  RandomMotions motions(3, 0);
  const object::WrenchFrame frame = FrameOf(3);
  GraspMotion motion = motions.Next(6);
  while (!DecidePathForceClosure(motion, frame, Radians(50)).holds()) motion = motions.Next(6);
  ProofBudget enough(1'000'000);
  EXPECT_TRUE(DecidePathForceClosure(motion, frame, Radians(50), enough).holds());
  EXPECT_LT(enough.left(), 1'000'000);
  // The budget is one piece more than the first motion needs. The second motion uses it up, and the
  // third finds none.
  const std::int64_t needed = 1'000'000 - enough.left();
  ProofBudget shared(needed + 1);
  EXPECT_TRUE(DecidePathForceClosure(motion, frame, Radians(50), shared).holds());
  static_cast<void>(DecidePathForceClosure(motion, frame, Radians(50), shared));
  const PathForceClosure ended = DecidePathForceClosure(motion, frame, Radians(50), shared);
  EXPECT_EQ(ended.decision, grasp::Decision::kTooClose);
  EXPECT_TRUE(ended.ended_early);
  EXPECT_EQ(ended.undecided, 0);
  const auto bounds = ComputePathRequiredFrictionAngle(motion, frame, Radians(50), shared);
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->upper, Radians(50));
  EXPECT_FALSE(ComputePathRequiredFrictionAngle(motion, frame, std::nullopt, shared));
}

/// Motions of four contacts whose points and normals stay in one plane.
/// The contacts are on the sides of a square, which may be rotated and moved in space.
class CoplanarMotions {
 public:
  enum class Family {
    kFree,           ///< on four sides, independently
    kParallel,       ///< two pairs on opposite sides
    kPointSymmetric  ///< on four sides, opposite contacts point-symmetric
  };

  CoplanarMotions(Family family, bool turned) : family_(family), turned_(turned) {}

  GraspMotion Next() {
    const Eigen::Matrix3d turn =
        turned_ ? Eigen::Quaterniond(Uniform(), Uniform(), Uniform(), Uniform())
                      .normalized()
                      .toRotationMatrix()
                : Eigen::Matrix3d::Identity();
    const Eigen::Vector3d shift =
        turned_ ? Eigen::Vector3d(Uniform(), Uniform(), Uniform()) : Eigen::Vector3d::Zero();
    std::array<std::array<double, 2>, 4> along;
    for (auto& ends : along) ends = {Uniform(), Uniform()};
    GraspMotion motion;
    for (int i = 0; i < 4; ++i) {
      const double sign = i < 2 ? 1 : -1;
      const int axis = family_ == Family::kParallel ? 1 : i % 2;
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      normal[axis] = -sign;
      const auto contact = [&](double place) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[axis] = sign;
        p[1 - axis] = place;
        return grasp::Contact{turn * p + shift, (turn * normal).normalized()};
      };
      const bool opposite = family_ == Family::kPointSymmetric && i >= 2;
      const auto& [from, to] = along[opposite ? i - 2 : i];
      motion.emplace_back(contact(opposite ? -from : from), contact(opposite ? -to : to));
    }
    return motion;
  }

 private:
  double Uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

  Family family_;
  bool turned_;
  std::mt19937 random_{kSeed};
};

TEST(PathForceClosure, BoundsMotionsInOnePlaneAsNearAsOthers) {
  using Family = CoplanarMotions::Family;
  const object::WrenchFrame frame = FrameOf(3);
  for (const Family family : {Family::kFree, Family::kParallel, Family::kPointSymmetric}) {
    for (const bool turned : {false, true}) {
      CoplanarMotions motions(family, turned);
      for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(family) << turned << i);
        const GraspMotion motion = motions.Next();
        const auto bounds = ComputePathRequiredFrictionAngle(motion, frame, std::nullopt);
        ASSERT_TRUE(bounds);
        double largest = 0;
        for (int k = 0; k <= 200; ++k) {
          const auto there =
              grasp::ComputeRequiredFrictionAngle(GraspAt(motion, k / 200.0), frame, 1e-7);
          ASSERT_TRUE(there);
          largest = std::max(largest, there->lower);
        }
        EXPECT_GE(bounds->upper, largest);
        EXPECT_GE(bounds->lower, largest - kPathAngleAccuracy);
        EXPECT_LE(bounds->upper - bounds->lower, 1.1 * kPathAngleAccuracy);
        EXPECT_TRUE(DecidePathForceClosure(motion, frame, bounds->upper).holds());
        const double below = largest - 2 * kPathAngleAccuracy;
        EXPECT_FALSE(below > 0 && DecidePathForceClosure(motion, frame, below).holds());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, PathForceClosureIn, testing::Values(2, 3),
                         [](const auto& info) { return info.param == 2 ? "Plane" : "Space"; });

}  // namespace path_force_closure_test
}  // namespace regrasp::motion
