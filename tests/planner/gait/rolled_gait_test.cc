#include "planner/gait/rolled_gait.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/gait/object_motion.h"
#include "planner/gait/rolling.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace rolled_gait_test {

using Eigen::Vector3d;

/// A gait of a ring hand that rotates a cube, with its setup.
class RolledGaitTest : public testing::Test {
 protected:
  explicit RolledGaitTest(double degrees = 150) : request_(RequestFor("cube", 0.8, degrees)) {
    request_.robustness = RobustnessLevel::kRequired;
    found_ = FindGait(request_);
    for (const grasp::Contact& contact : found_.contacts) {
      points_.push_back({request_.scale * contact.p, contact.n});
    }
    for (const kinematics::Finger& finger : Ring().fingers) inverse_.emplace_back(finger);
  }

  [[nodiscard]] RolledGait Roll(const Gait& gait, double friction_angle) const {
    const HandSetup setup{scene_, inverse_, points_, request_.scale};
    return RollContacts(setup, cube_, friction_angle, gait, RandomStream(1, RandomUse::kGaits));
  }
  [[nodiscard]] RolledGait Roll(const Gait& gait) const {
    return Roll(gait, request_.criteria.friction_angle);
  }

  GaitRequest request_;
  GaitResult found_;
  const collision::SurfaceTree surface_{*request_.solid, request_.scale};
  const HandScene scene_{Ring(), surface_, 1e-3};
  const collision::BallContact cube_{*request_.solid, request_.scale};
  std::vector<kinematics::InverseKinematics> inverse_;
  std::vector<SurfacePoint> points_;
};

TEST_F(RolledGaitTest, ObjectPosesAndContactChangesAreThoseOfTheGait) {
  ASSERT_TRUE(found_.gait) << found_.message;
  const RolledGait rolled = Roll(*found_.gait);
  ASSERT_TRUE(rolled.gait);
  ASSERT_EQ(rolled.gait->segments.size(), found_.gait->segments.size());
  for (std::size_t i = 0; i < rolled.gait->segments.size(); ++i) {
    const PlanSegment& segment = rolled.gait->segments[i];
    const PlanSegment& before = found_.gait->segments[i];
    EXPECT_EQ(segment.kind, before.kind);
    EXPECT_EQ(segment.finger, before.finger);
    EXPECT_EQ(segment.contact, before.contact);
    EXPECT_EQ(segment.path.back().pose.matrix(), before.path.back().pose.matrix());
    EXPECT_EQ(segment.rolled.size(),
              segment.kind == PlanSegment::Kind::kMove ? segment.path.size() : 0);
  }
  EXPECT_EQ(AssignmentAtEnd(*rolled.gait), AssignmentAtEnd(*found_.gait));
}

/// On a face, Σ Δθ × (r n) over the keyframes is the motion of the contact.
TEST_F(RolledGaitTest, ContactsRollByRadiusTimesRotation) {
  ASSERT_TRUE(found_.gait) << found_.message;
  const RolledGait rolled = Roll(*found_.gait);
  ASSERT_TRUE(rolled.gait);
  int compared = 0;
  for (const PlanSegment& segment : rolled.gait->segments) {
    for (std::size_t k = 0; !segment.rolled.empty() && k < segment.rolled[0].size(); ++k) {
      const plan::FingerContact& first = segment.rolled.front()[k];
      const plan::FingerContact& last = segment.rolled.back()[k];
      if (!first.contact.n.isApprox(last.contact.n, 1e-9)) continue;
      const kinematics::Finger& finger = Ring().fingers[first.finger];
      Vector3d way = Vector3d::Zero();
      for (std::size_t i = 1; i < segment.path.size(); ++i) {
        const auto turn_at = [&](const Keyframe& frame) {
          return FingertipOrientation(finger, frame.configurations[first.finger], frame.pose);
        };
        const Eigen::AngleAxisd turn(turn_at(segment.path[i]) *
                                     turn_at(segment.path[i - 1]).transpose());
        way += (turn.angle() * turn.axis()).cross(-finger.tip.radius * first.contact.n);
      }
      const Vector3d moved = request_.scale * (last.contact.p - first.contact.p);
      EXPECT_LT((moved - way).norm(), 2e-5);
      compared += moved.norm() > 1e-3;
    }
  }
  EXPECT_GT(compared, 0) << "no contact rolls by a millimetre";
}

TEST_F(RolledGaitTest, FingertipsAreAtTheirContactsInEveryKeyframe) {
  ASSERT_TRUE(found_.gait) << found_.message;
  const RolledGait rolled = Roll(*found_.gait);
  ASSERT_TRUE(rolled.gait);
  for (const PlanSegment& segment : rolled.gait->segments) {
    for (std::size_t i = 0; i < segment.rolled.size(); ++i) {
      for (const plan::FingerContact& held : segment.rolled[i]) {
        const kinematics::Finger& finger = Ring().fingers[held.finger];
        const Vector3d centre =
            kinematics::TipAt(finger, segment.path[i].configurations[held.finger]).centre;
        const SurfacePoint contact{request_.scale * held.contact.p, held.contact.n};
        EXPECT_LT((centre - TargetAt(finger, contact, segment.path[i].pose).centre).norm(), 1e-8);
      }
    }
  }
}

TEST_F(RolledGaitTest, WithoutFrictionNothingRolls) {
  ASSERT_TRUE(found_.gait) << found_.message;
  const RolledGait rolled = Roll(*found_.gait, Radians(1));
  EXPECT_FALSE(rolled.gait);
  EXPECT_EQ(rolled.reason, plan::Reason::kNotForceClosure);
  EXPECT_LT(rolled.segments, std::ssize(found_.gait->segments));
}

TEST_F(RolledGaitTest, AMotionOutOfReachFails) {
  ASSERT_TRUE(found_.gait) << found_.message;
  Gait gait{found_.gait->initial, found_.gait->start, {}};
  Keyframe away = gait.start;
  away.pose.translation().z() += 0.3;
  gait.segments = {{PlanSegment::Kind::kMove, {}, kNone, {gait.start, away}}};
  const RolledGait rolled = Roll(gait);
  EXPECT_FALSE(rolled.gait);
  EXPECT_EQ(rolled.segments, 0);
  EXPECT_TRUE(rolled.reason == plan::Reason::kTipOffContact ||
              rolled.reason == plan::Reason::kHandCollides);
}

TEST_F(RolledGaitTest, AGraspThatLosesForceClosureWhenAFingerLeavesFails) {
  ASSERT_TRUE(found_.gait) << found_.message;
  // A finger of three leaves, and the other two do not hold the cube.
  Gait gait{found_.gait->initial, found_.gait->start, {}};
  while (CountHoldingFingers(gait.initial) > 3)
    *std::ranges::find_if(gait.initial, [](int p) { return p != kNone; }) = kNone;
  const auto holding = std::ranges::find_if(gait.initial, [](int p) { return p != kNone; });
  const FingerIndex finger(static_cast<int>(holding - gait.initial.begin()));
  Keyframe idle = gait.start;
  for (const PlanSegment& segment : found_.gait->segments) {
    if (segment.kind != PlanSegment::Kind::kRelease || segment.finger != finger) continue;
    idle.configurations[finger] = segment.path.back().configurations[finger];
  }
  gait.segments = {{PlanSegment::Kind::kRelease, finger, *holding, {gait.start, idle}}};
  const RolledGait rolled = Roll(gait);
  EXPECT_FALSE(rolled.gait);
}

TEST_F(RolledGaitTest, TheSameInputGivesTheSameBits) {
  ASSERT_TRUE(found_.gait) << found_.message;
  const RolledGait once = Roll(*found_.gait);
  const RolledGait again = Roll(*found_.gait);
  ASSERT_TRUE(once.gait && again.gait);
  EXPECT_EQ(EndOf(*once.gait).configurations, EndOf(*again.gait).configurations);
}

}  // namespace rolled_gait_test
}  // namespace regrasp::gait
