#include "planner/gait/object_motion.h"

#include <gtest/gtest.h>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace object_motion_test {

/// If no candidate posture is free, random postures are drawn. They must be clear of the own hand.
TEST(ObjectMotionCheckerTest, RandomIdleConfigurationsAreClearOfTheHand) {
  const kinematics::HandModel hand = kinematics::ReadHand(ProjectPath("models/hands/ring4.json"));
  const auto file = object::ReadObject(ProjectPath("models/cube.obj"));
  const collision::SurfaceTree surface(dynamic_cast<const object::Polyhedron&>(*file.object), 0.5);
  const HandScene scene(hand, surface, 1e-3);
  std::vector<kinematics::InverseKinematics> inverse;
  inverse.reserve(hand.fingers.size());
  for (const kinematics::Finger& finger : hand.fingers) inverse.emplace_back(finger);
  const std::vector<SurfacePoint> points;
  const HandSetup setup{scene, inverse, points};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = 0.5 * hand.up;  // clear of every finger
  const PoseGrid grid({pose, Eigen::Vector3d::Zero(), {}, Eigen::Vector3d::Zero(), 0}, hand.up,
                      PoseGrid::End::kPose);
  const IdleConfigurations no_configurations(scene.finger_count());
  ObjectMotionChecker checker(setup, grid, no_configurations);
  int would_collide = 0;
  for (int seed = 0; seed < 60; ++seed) {
    RandomStream random(seed, RandomUse::kGaits);
    RandomStream same(seed, RandomUse::kGaits);
    const FingerIndex first{same.Choose(scene.finger_count(), scene.finger_count()).front()};
    would_collide += !scene.KeepsOffHand(scene.Place(first, scene.DrawConfiguration(first, same)));
    Stance stance{ContactAssignment(scene.finger_count(), kNone)};
    ASSERT_TRUE(checker.PlaceIdleFingers(stance, grid.start(), &random));
    for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
      EXPECT_TRUE(scene.KeepsOffHand(scene.Place(finger, stance.idle[finger]))) << seed;
    }
  }
  // Negative control: the first random posture does not always suffice.
  EXPECT_GT(would_collide, 0);
}

}  // namespace object_motion_test
}  // namespace regrasp::gait
