#include "planner/gait/plan_of_gait.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace plan_of_gait_test {

/// A hand rotates a cube.
class MergeMovesTest : public testing::Test {
 protected:
  MergeMovesTest() {
    request_.hand = &hand_;
    request_.solid = &cube_;
    request_.scale = 0.8;
    request_.criteria.friction_angle = std::atan(0.8);
    request_.turn = {Eigen::Vector3d::UnitZ(), Radians(30)};
    request_.robustness = RobustnessLevel::kNone;
    found_ = FindGait(request_);
    for (const grasp::Contact& contact : found_.contacts) {
      points_.push_back({request_.scale * contact.p, contact.n});
    }
    for (const kinematics::Finger& finger : hand_.fingers) inverse_.emplace_back(finger);
  }

  const kinematics::HandModel hand_ = kinematics::ReadHand(ProjectPath("models/hands/ring4.json"));
  const object::ObjectFile file_ = object::ReadObject(ProjectPath("models/cube.obj"));
  const object::Polyhedron& cube_ = dynamic_cast<const object::Polyhedron&>(*file_.object);
  GaitRequest request_;
  GaitResult found_;
  const collision::SurfaceTree surface_{cube_, 0.8};
  const HandScene scene_{hand_, surface_, 1e-3};
  const collision::BallContact rolled_on_{cube_, 0.8};
  std::vector<kinematics::InverseKinematics> inverse_;
  std::vector<SurfacePoint> points_;
};

/// A motion, its reverse and the motion again merge into one; a motion and its reverse into none.
TEST_F(MergeMovesTest, DetoursAreRemovedUnlessContactsRoll) {
  const HandSetup setup{scene_, inverse_, points_, 0.8};
  ASSERT_TRUE(found_.gait) << found_.message;
  ASSERT_EQ(found_.gait->segments.size(), 1u);
  const PlanSegment to = found_.gait->segments[0];
  ASSERT_EQ(to.kind, PlanSegment::Kind::kMove);
  Gait gait = *found_.gait;
  gait.segments = {to, Reversed(to)};
  EXPECT_TRUE(MergeMoves(setup, gait).segments.empty());
  gait.segments.push_back(to);
  const Gait fewer = MergeMoves(setup, gait);
  ASSERT_EQ(fewer.segments.size(), 1u);
  EXPECT_LE(fewer.segments[0].path.size(), to.path.size());
  EXPECT_EQ(EndOf(fewer).pose.matrix(), EndOf(gait).pose.matrix());
  EXPECT_EQ(EndOf(fewer).configurations, EndOf(gait).configurations);
  // If contacts roll, each path to a pose ends at other contacts.
  const HandSetup rolling{scene_, inverse_, points_, 0.8, &rolled_on_};
  const Gait rolled = MergeMoves(rolling, gait);
  ASSERT_EQ(rolled.segments.size(), 1u);
  EXPECT_EQ(rolled.segments[0].path.size(), 3 * to.path.size() - 2);
}

/// A straight motion that is infeasible is rejected.
TEST_F(MergeMovesTest, AnInfeasibleStraightMotionIsRejected) {
  const HandSetup setup{scene_, inverse_, points_, 0.8};
  ASSERT_TRUE(found_.gait) << found_.message;
  Gait gait = *found_.gait;
  // A pose half a metre away is out of reach.
  Keyframe away = gait.start;
  away.pose.translation().x() += 0.5;
  gait.segments = {{PlanSegment::Kind::kMove, {}, kNone, {gait.start, EndOf(gait), away}}};
  const Gait same = MergeMoves(setup, gait);
  ASSERT_EQ(same.segments.size(), 1u);
  EXPECT_EQ(same.segments[0].path.size(), 3u);
}

}  // namespace plan_of_gait_test
}  // namespace regrasp::gait
