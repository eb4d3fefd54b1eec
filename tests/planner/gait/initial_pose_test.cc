#include "planner/gait/initial_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/fixtures/solids.h"
#include "tests/planner/gait/gait_requests.h"
#include "tests/planner/gait/gait_world.h"

namespace regrasp::gait {
namespace initial_pose_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::vector<Isometry3d> PosesOf(GaitWorld& world, const GaitEnds& ends, std::uint64_t seed = 1) {
  RandomStream random(seed, RandomUse::kHomes);
  return FindInitialPoses(world.setup, world.task, ends, world.memory, random);
}

double TiltOf(const Isometry3d& pose) {
  return (pose.linear() * Vector3d::UnitZ() - Ring().up).norm();
}

/// Return how many fingers reach some contact at a pose.
int CountReachingFingers(const GaitWorld& world, const Isometry3d& pose) {
  const PoseGrid grid({pose, Vector3d::Zero(), {}, Vector3d::Zero(), 0}, Ring().up,
                      PoseGrid::End::kPose);
  ReachMap reach(world.scene, world.setup.inverse, world.setup.points, grid);
  int count = 0;
  for (FingerIndex finger{0}; finger < world.scene.finger_count(); ++finger) {
    bool reaches = false;
    for (int point = 0; point < kWorldContacts && !reaches; ++point) {
      reaches = reach.Find(finger, point, grid.start()) != nullptr;
    }
    count += static_cast<int>(reaches);
  }
  return count;
}

TEST(FindInitialPosesTest, PosesAreUprightClearOfThePalmAndWithinReach) {
  GaitWorld world(RequestFor("cube", 0.8, 90));
  const std::vector<Isometry3d> poses = PosesOf(world, {});
  ASSERT_FALSE(poses.empty());
  EXPECT_LE(poses.size(), 24U);
  for (const Isometry3d& pose : poses) {
    EXPECT_LT(TiltOf(pose), 1e-12);
    EXPECT_TRUE(world.scene.KeepsOffPalm(pose));
  }
  EXPECT_GE(CountReachingFingers(world, poses.front()), 3);
  // Negative control: half a metre higher no finger reaches the object.
  EXPECT_EQ(CountReachingFingers(world, Eigen::Translation3d(0.5 * Ring().up) * poses.front()), 0);
}

/// Count upright poses and poses on a side.
std::pair<int, int> CountUprightAndLying(double degrees, const Vector3d& axis,
                                         const object::Polyhedron& solid = Model("cube")) {
  GaitRequest request = RequestFor("cube", 0.8, degrees);
  request.turn.axis = axis;
  request.solid = &solid;
  GaitWorld world(request);
  std::pair<int, int> count;
  for (const Isometry3d& pose : PosesOf(world, {})) {
    const double tilt = TiltOf(pose);
    count.first += static_cast<int>(tilt < 1e-9);
    count.second += static_cast<int>(std::abs(tilt - std::numbers::sqrt2) < 1e-9);
    EXPECT_TRUE(world.scene.KeepsOffPalm(pose));
  }
  return count;
}

TEST(FindInitialPosesTest, AFullTurnAboutTheVerticalMayBeginOnASide) {
  const auto [upright, lying] = CountUprightAndLying(360, Vector3d::UnitZ());
  EXPECT_GT(upright, 0);
  EXPECT_GT(lying, 0);
  // Other turns begin with the upright object.
  for (const auto& count : {CountUprightAndLying(360, Vector3d::UnitX()),
                            CountUprightAndLying(90, Vector3d::UnitZ())}) {
    EXPECT_GT(count.first, 0);
    EXPECT_EQ(count.second, 0);
  }
}

TEST(FindInitialPosesTest, ASlenderObjectMayBeginAHalfTurnOnASide) {
  const object::Polyhedron rod = MakeBox({0.03, 0.03, 0.15});
  EXPECT_GT(CountUprightAndLying(180, Vector3d::UnitX(), rod).second, 0);
  // Compact objects, and shorter turns, begin with the upright object.
  const object::Polyhedron brick = MakeBox({0.03, 0.03, 0.06});
  EXPECT_EQ(CountUprightAndLying(180, Vector3d::UnitX(), brick).second, 0);
  EXPECT_EQ(CountUprightAndLying(90, Vector3d::UnitX(), rod).second, 0);
}

TEST(FindInitialPosesTest, PosesDependOnTheRandomStreamOnly) {
  GaitWorld world(RequestFor("cube", 0.8, 90));
  const std::vector<Isometry3d> poses = PosesOf(world, {});
  const std::vector<Isometry3d> same = PosesOf(world, {});
  ASSERT_FALSE(poses.empty());
  ASSERT_EQ(poses.size(), same.size());
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].matrix(), same[i].matrix());
  EXPECT_NE(PosesOf(world, {}, 2).front().matrix(), poses.front().matrix());
}

/// Three contacts around a cube of 48 mm. Poses may have any orientation.
TEST(FindInitialPosesTest, TheContactsOfAGivenGraspAreWithinReach) {
  const grasp::Grasp grasp = {{{0.03, 0, 0}, -Vector3d::UnitX(), {}},
                              {{-0.03, 0.005, 0}, Vector3d::UnitX(), {}},
                              {{-0.03, -0.005, 0}, Vector3d::UnitX(), {}}};
  GaitWorld world(RequestFor("cube", 0.8, 0), grasp);
  const GaitEnds ends{{kWorldContacts, kWorldContacts + 1, kWorldContacts + 2}, {}};
  const auto is_reached = [&](int contact, const Isometry3d& pose) {
    for (FingerIndex finger{0}; finger < world.scene.finger_count(); ++finger) {
      const auto target = TargetAt(world.scene.finger(finger), world.setup.points[contact], pose);
      if (world.setup.inverse[finger].MayReach(target)) return true;
    }
    return false;
  };
  const auto all_are_reached = [&](const Isometry3d& pose) {
    return std::ranges::all_of(ends.start, [&](int contact) { return is_reached(contact, pose); });
  };
  const std::vector<Isometry3d> poses = PosesOf(world, ends);
  ASSERT_FALSE(poses.empty());
  double tilt = 0;
  for (const Isometry3d& pose : poses) {
    EXPECT_TRUE(all_are_reached(pose));
    tilt = std::max(tilt, TiltOf(pose));
  }
  EXPECT_GT(tilt, 0.1);
  // Negative control: half a metre higher the contacts are out of reach.
  EXPECT_FALSE(all_are_reached(Eigen::Translation3d(0.5 * Ring().up) * poses.front()));
}

/// Contacts at opposite corners of a cube of 1.2 m.
TEST(FindInitialPosesTest, AGoalGraspThatNoFingersReachHasNoPose) {
  const double far = 0.0299;
  const grasp::Grasp grasp = {{{0.03, far, far}, -Vector3d::UnitX(), {}},
                              {{-0.03, far, far}, Vector3d::UnitX(), {}},
                              {{0.03, -far, -far}, -Vector3d::UnitX(), {}}};
  GaitWorld world(RequestFor("cube", 20, 0), grasp);
  const std::vector<int> numbers = {kWorldContacts, kWorldContacts + 1, kWorldContacts + 2};
  EXPECT_TRUE(PosesOf(world, {{}, numbers}).empty());
  // Negative control: one of the contacts alone is within reach.
  EXPECT_FALSE(PosesOf(world, {{}, {kWorldContacts}}).empty());
}

/// Law: idle postures are clear of the hand and of the object along the track.
TEST(FindIdleConfigurationsTest, ConfigurationsAreClearOfHandAndObject) {
  GaitWorld world(RequestFor("cube", 0.8, 90));
  const PoseTrack track = world.task.From(world.BestPose());
  RandomStream random(1, RandomUse::kHomes);
  const std::optional<IdleConfigurations> configurations =
      FindIdleConfigurations(world.setup, track, random);
  ASSERT_TRUE(configurations);
  for (FingerIndex finger{0}; finger < world.scene.finger_count(); ++finger) {
    ASSERT_FALSE((*configurations)[finger].empty());
    for (const JointConfiguration& configuration : (*configurations)[finger]) {
      const PlacedFinger placed = world.scene.Place(finger, configuration);
      EXPECT_TRUE(world.scene.KeepsOffHand(placed));
      EXPECT_TRUE(world.scene.KeepsOffObject(placed, track.PoseAt(0), TipContact::kFree));
      EXPECT_TRUE(
          world.scene.KeepsOffObject(placed, track.PoseAt(track.steps()), TipContact::kFree));
    }
  }
  // Negative control: random postures are not always clear.
  int blocked = 0;
  for (int i = 0; i < 200; ++i) {
    const FingerIndex finger{i % world.scene.finger_count()};
    const PlacedFinger placed =
        world.scene.Place(finger, world.scene.DrawConfiguration(finger, random));
    blocked +=
        static_cast<int>(!world.scene.KeepsOffHand(placed) ||
                         !world.scene.KeepsOffObject(placed, track.PoseAt(0), TipContact::kFree));
  }
  EXPECT_GT(blocked, 0);
}

}  // namespace initial_pose_test
}  // namespace regrasp::gait
