#include "planner/gait/stance_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/gait/find_gait.h"
#include "planner/gait/finger_path.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace stance_tree_test {

using Eigen::Vector3d;

GaitRequest RequestAtRest(const kinematics::HandModel& hand, const object::Polyhedron& solid,
                          double scale) {
  GaitRequest request;
  request.hand = &hand;
  request.solid = &solid;
  request.scale = scale;
  request.criteria.friction_angle = std::atan(0.8);
  request.robustness = RobustnessLevel::kNone;
  request.seed = 2;
  return request;
}

/// A hand that holds an object with three fingers.
class StanceTreeTest : public testing::Test {
 protected:
  explicit StanceTreeTest(const char* model = "models/cube.obj", double scale = 0.8,
                          const char* hand = "models/hands/ring4.json")
      : hand_(kinematics::ReadHand(ProjectPath(hand))),
        file_(object::ReadObject(ProjectPath(model))),
        request_(RequestAtRest(hand_, solid_, scale)) {
    memory_.Append(found_.contacts);
    for (const grasp::Contact& contact : found_.contacts) {
      points_.push_back({request_.scale * contact.p, contact.n});
    }
    for (const kinematics::Finger& finger : hand_.fingers) inverse_.emplace_back(finger);
    while (first_.assignment[free_] != kNone) ++free_;
  }

  StanceTree Tree(bool has_given_start) {
    return {setup_,
            grid_,
            checker_,
            memory_,
            routes_,
            random_,
            [](int /*node*/, const ContactAssignment& /*assignment*/) { return false; },
            has_given_start};
  }
  int AddFirst(StanceTree& tree) {
    const int first = tree.Add({.stance = first_, .node = grid_.start()});
    EXPECT_TRUE(tree.PlanPathFromParent(tree[first]));
    return first;
  }
  JointConfiguration FreeConfiguration() { return FreeConfigurationOf(free_, first_); }
  /// Draw a collision-free idle posture.
  JointConfiguration FreeConfigurationOf(FingerIndex finger, Stance stance) {
    do {
      stance.idle[finger] = setup_.scene.DrawConfiguration(finger, random_);
    } while (!setup_.scene.KeepsOffHand(setup_.scene.Place(finger, stance.idle[finger])) ||
             !checker_.IsPassable(stance, grid_.start()));
    return stance.idle[finger];
  }
  Vector3d TipOf(const JointConfiguration& configuration) const {
    return kinematics::TipAt(hand_.fingers[free_], configuration).centre;
  }

  const kinematics::HandModel hand_;
  const object::ObjectFile file_;
  const object::Polyhedron& solid_ = dynamic_cast<const object::Polyhedron&>(*file_.object);
  const GaitRequest request_;
  const GaitResult found_ = FindGait(request_);
  const collision::SurfaceTree surface_{solid_, request_.scale};
  const HandScene scene_{hand_, surface_, request_.margin};
  std::vector<kinematics::InverseKinematics> inverse_;
  std::vector<SurfacePoint> points_;
  const HandSetup setup_{scene_, inverse_, points_, request_.scale};
  criteria::GraspMemory memory_{solid_, request_.criteria, FingersOf(request_),
                                criteria::QualityTest::kQuick};
  const IdleConfigurations no_configurations_ = IdleConfigurations(hand_.fingers.size());
  const PoseGrid grid_{{found_.gait->start.pose, Vector3d::Zero(), {}, Vector3d::Zero(), 0},
                       hand_.up,
                       PoseGrid::End::kPose};
  ObjectMotionChecker checker_{setup_, grid_, no_configurations_};
  SlideRoutes routes_{memory_};
  RandomStream random_{1, RandomUse::kGaits};
  const Stance first_{found_.gait->initial, found_.gait->start.configurations};
  FingerIndex free_{0};
};

TEST_F(StanceTreeTest, AnIdleFingerMayStartElsewhere) {
  StanceTree tree = Tree(true);
  const int first = AddFirst(tree);
  const JointConfiguration elsewhere = FreeConfiguration();
  const int other = tree.WithIdleConfiguration(first, free_, elsewhere);
  ASSERT_GE(other, 0);
  EXPECT_EQ(tree[other].stance.assignment, first_.assignment);
  EXPECT_EQ(tree[other].at.configurations[free_], elsewhere);
  EXPECT_EQ(tree[first].at.configurations[free_], first_.idle[free_]);
}

TEST_F(StanceTreeTest, IdlePosturesMustBeClearAndOnlyIdleFingersOfAGivenStartMayChange) {
  StanceTree tree = Tree(true);
  const int first = AddFirst(tree);
  int touching = 0;
  for (int point = 0; point < std::ssize(points_); ++point) {
    const JointConfiguration* there = checker_.reach().Find(free_, point, grid_.start());
    if (there == nullptr) continue;
    ++touching;
    EXPECT_LT(tree.WithIdleConfiguration(first, free_, *there), 0);
  }
  EXPECT_GT(touching, 0);
  const FingerIndex holding_finger{(free_ + 1) % 4};
  EXPECT_LT(tree.WithIdleConfiguration(first, holding_finger, FreeConfiguration()), 0);
  StanceTree others = Tree(false);
  EXPECT_LT(others.WithIdleConfiguration(AddFirst(others), free_, FreeConfiguration()), 0);
}

/// The finger idles a few millimetres above its future contact.
TEST_F(StanceTreeTest, APlacedFingerMayIdleAboveItsContactBefore) {
  StanceTree tree = Tree(true);
  const int first = AddFirst(tree);
  int reached = 0;
  for (int point = 0; point < std::ssize(points_); ++point) {
    if (checker_.reach().Find(free_, point, grid_.start()) == nullptr) continue;
    ContactAssignment to = first_.assignment;
    to[free_] = point;
    if (!checker_.IsPassable({to}, grid_.start())) continue;
    const int placed = tree.Add(tree.After(first, to, grid_.start()));
    const int after = tree.AfterIdlingAbove(placed);
    if (after < 0) continue;
    ++reached;
    const StanceNode& begin = tree[tree[after].parent];
    EXPECT_EQ(begin.stance.assignment, first_.assignment);
    const Vector3d ball =
        TargetAt(hand_.fingers[free_], points_[point], grid_.PoseAt(grid_.start())).centre;
    const double above = (TipOf(begin.at.configurations[free_]) - ball).norm();
    EXPECT_GT(above, 0.005);
    EXPECT_LT(above, 0.021);
    const auto gait = tree.PathTo(after, grid_.start());
    ASSERT_TRUE(gait);
    EXPECT_EQ(gait->start.configurations, begin.at.configurations);
    ASSERT_EQ(gait->segments.size(), 1u);
    EXPECT_EQ(gait->segments[0].contact, point);
  }
  EXPECT_GT(reached, 0);
}

/// Two fingers are idle.
class FiveFingersTest : public StanceTreeTest {
 protected:
  FiveFingersTest() : StanceTreeTest("models/cube.obj", 0.8, "models/hands/ring5.json") {
    other_free_ = FingerIndex(free_ + 1);
    while (first_.assignment[other_free_] != kNone) ++other_free_;
    while (first_.assignment[holding_finger_] == kNone) ++holding_finger_;
  }

  FingerIndex other_free_;
  FingerIndex holding_finger_{0};
};

/// The node was planned with another posture of the second idle finger.
TEST_F(FiveFingersTest, ACopiedNodeKeepsTheIdlePosturesOfItsParent) {
  StanceTree tree = Tree(true);
  const int first = AddFirst(tree);
  ContactAssignment released = first_.assignment;
  released[holding_finger_] = kNone;
  StanceNode after = tree.After(first, released, grid_.start());
  after.stance.idle[holding_finger_] = FreeConfigurationOf(holding_finger_, after.stance);
  const int second = tree.Add(after);
  ASSERT_TRUE(tree.PlanPathFromParent(tree[second]));
  tree[second].stance.idle[other_free_] = FreeConfigurationOf(other_free_, tree[second].stance);
  ASSERT_NE(tree[second].stance.idle[other_free_], first_.idle[other_free_]);

  const int anew =
      tree.WithIdleConfiguration(second, free_, FreeConfigurationOf(free_, tree[second].stance));
  ASSERT_GE(anew, 0);
  const StanceNode& before = tree[tree[anew].parent];
  EXPECT_EQ(before.stance.idle[other_free_], first_.idle[other_free_]);
  EXPECT_EQ(tree[anew].stance.idle[other_free_], first_.idle[other_free_]);
}

/// The same when the placed finger idles above its contact.
TEST_F(FiveFingersTest, ANodeAfterIdlingAboveKeepsTheIdlePosturesOfItsParent) {
  StanceTree tree = Tree(true);
  const int first = AddFirst(tree);
  int reached = 0;
  for (int point = 0; point < std::ssize(points_) && reached == 0; ++point) {
    if (checker_.reach().Find(free_, point, grid_.start()) == nullptr) continue;
    ContactAssignment to = first_.assignment;
    to[free_] = point;
    if (!checker_.IsPassable({to}, grid_.start())) continue;
    StanceNode placed = tree.After(first, to, grid_.start());
    placed.stance.idle[other_free_] = FreeConfigurationOf(other_free_, placed.stance);
    ASSERT_NE(placed.stance.idle[other_free_], first_.idle[other_free_]);
    const int after = tree.AfterIdlingAbove(tree.Add(placed));
    if (after < 0) continue;
    ++reached;
    EXPECT_EQ(tree[after].stance.idle[other_free_], first_.idle[other_free_]);
  }
  EXPECT_GT(reached, 0);
}

/// Between the two arms of the L the normal is blocked.
class LiftPathTest : public StanceTreeTest {
 protected:
  LiftPathTest() : StanceTreeTest("models/l_block.obj", 0.9) {}

  /// Draw a pose near that of the stance.
  Eigen::Isometry3d DrawPose() {
    Eigen::Isometry3d pose = found_.gait->start.pose;
    for (int k = 0; k < 3; ++k) pose.translation()[k] += 0.04 * (random_.Uniform() - 0.5);
    pose.rotate(Eigen::AngleAxisd(2 * std::numbers::pi * random_.Uniform(), Vector3d::UnitZ()));
    return pose;
  }
};

/// Lifts along the normal, or tilted if blocked; near the object only close to the contact.
TEST_F(LiftPathTest, LiftsOffTheSurface) {
  int along_normal = 0;
  int tilted = 0;
  int near = 0;
  for (int i = 0; i < 200; ++i) {
    const FingerIndex finger{i % scene_.finger_count()};
    Keyframe frame{DrawPose(), {}};
    for (const kinematics::InverseKinematics& inverse : inverse_) {
      frame.configurations.push_back(inverse.middle());
    }
    const Surroundings around = AllExcept(scene_, finger, frame);
    for (const SurfacePoint& point : points_) {
      const kinematics::TipTarget target = TargetAt(hand_.fingers[finger], point, around.pose);
      const auto touching = inverse_[finger].Solve(target);
      if (!touching) continue;
      const PlacedFinger there = scene_.Place(finger, *touching);
      if (!scene_.KeepsOffHand(there) ||
          !scene_.KeepsOffObject(there, around.pose, TipContact::kTouching)) {
        continue;
      }
      const auto lift_path =
          FindLiftPath(scene_, inverse_[finger], finger, target, *touching, around);
      if (!lift_path) continue;
      const auto tip = [&](const JointConfiguration& configuration) {
        return kinematics::TipAt(hand_.fingers[finger], configuration).centre;
      };
      EXPECT_EQ(lift_path->front(), *touching);
      const Vector3d off = tip(lift_path->back()) - target.centre;
      EXPECT_GT(off.norm(), 0.0029);
      const double waypoints = off.normalized().dot(-target.towards);
      EXPECT_GT(waypoints, 0.5);
      ++(waypoints > 0.999 ? along_normal : tilted);
      for (const JointConfiguration& configuration : *lift_path) {
        const PlacedFinger placed = scene_.Place(finger, configuration);
        EXPECT_TRUE(scene_.KeepsOffHand(placed, 0.0));
        const bool is_off = scene_.KeepsOffObject(placed, around.pose, TipContact::kFree, 0.0);
        near += static_cast<int>(!is_off);
        EXPECT_TRUE(is_off || (tip(configuration) - target.centre).norm() < 0.012);
      }
    }
  }
  EXPECT_GT(along_normal, 0);
  EXPECT_GT(tilted, 0);
  EXPECT_GT(near, 0);
}

}  // namespace stance_tree_test
}  // namespace regrasp::gait
