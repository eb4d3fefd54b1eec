#include "planner/gait/finger_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "planner/base/random.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {
namespace finger_path_test {

constexpr double kMargin = 1e-3;

/// The ring hand around a cube of 48 mm.
struct World {
  kinematics::HandModel hand = kinematics::ReadHand(ProjectPath("models/hands/ring4.json"));
  object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  collision::SurfaceTree surface{dynamic_cast<const object::Polyhedron&>(*file.object), 0.8};
  HandScene scene{hand, surface, kMargin};

  Keyframe Random(RandomStream& random) const {
    Keyframe frame;
    frame.pose.translation() = Eigen::Vector3d(0.02 * random.Normal(), 0.02 * random.Normal(),
                                               0.07 + 0.01 * random.Normal());
    frame.pose.linear() =
        Eigen::AngleAxisd(random.Normal(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (const kinematics::Finger& finger : hand.fingers) {
      kinematics::JointConfiguration configuration(finger.drives);
      for (int i = 0; i < finger.drives; ++i) {
        configuration[i] =
            finger.lower[i] + (finger.upper[i] - finger.lower[i]) * 0.5 * random.Uniform();
      }
      frame.configurations.push_back(configuration);
    }
    return frame;
  }
  /// Distance between fingers and object, by sampling.
  [[nodiscard]] double NearestToObject(const Keyframe& frame) const {
    double nearest = 1;
    for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
      nearest =
          std::min(nearest, scene.DistanceFromObject(
                                scene.Place(finger, frame.configurations[finger]), frame.pose, 1));
    }
    return nearest;
  }
};

TEST(FingerPathTest, CertifiedPathsAreClearAtEverySample) {
  const World world;
  RandomStream random(1, RandomUse::kGaits);
  int clear = 0;
  int blocked = 0;
  const Touching free(4, TipContact::kFree);
  for (int i = 0; i < 600; ++i) {
    const Keyframe from = world.Random(random);
    const Keyframe to = Between(from, world.Random(random), 0.3);
    double nearest = 1;
    for (int k = 0; k <= 60; ++k) {
      nearest = std::min(nearest, world.NearestToObject(Between(from, to, k / 60.0)));
    }
    if (IsClear(world.scene, from, to, free)) {
      ++clear;
      EXPECT_GT(nearest, kMargin);
    } else {
      ++blocked;
    }
    if (nearest < kMargin) {
      EXPECT_FALSE(IsClear(world.scene, from, to, free));
    }
  }
  EXPECT_GT(clear, 20);
  EXPECT_GT(blocked, 20);
}

TEST(FingerPathTest, APathAndItsReverseHaveTheSameVerdict) {
  const World world;
  RandomStream random(2, RandomUse::kGaits);
  const Touching free(4, TipContact::kFree);
  for (int i = 0; i < 100; ++i) {
    const Keyframe from = world.Random(random);
    const Keyframe to = Between(from, world.Random(random), 0.3);
    EXPECT_EQ(IsClear(world.scene, from, to, free), IsClear(world.scene, to, from, free));
  }
}

}  // namespace finger_path_test
}  // namespace regrasp::gait
