#include "planner/gait/hand_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "planner/base/random.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/inspect_hand.h"
#include "planner/kinematics/mujoco_model.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/solids.h"
#include "tests/planner/kinematics/ring_model.h"

namespace regrasp::gait {
namespace hand_scene_test {

using kinematics::HandModel;

/// Hands of three fingers, whose fingertip bodies may have additional collision geometry.
class HandSceneTest : public FolderTest {
 protected:
  HandModel HandWith(const std::string& inside) {
    const kinematics::HandDescription description =
        kinematics::InspectHand(Write("plain.xml", kinematics::RingXml())).description;
    const auto path = Write("ring.xml", kinematics::RingXml({.inside = inside}));
    return kinematics::BuildHand(description, kinematics::CompileModel(path), "ring.json");
  }
};

/// Count the random pairs of fingers that are apart.
int CountApart(const HandModel& hand) {
  const object::Polyhedron cube = MakeCube(0.01);
  const collision::SurfaceTree surface(cube, 1);
  const HandScene scene(hand, surface, 1e-3);
  RandomStream random(1, RandomUse::kGaits);
  int count = 0;
  for (int i = 0; i < 500; ++i) {
    const PlacedFinger one =
        scene.Place(FingerIndex{0}, scene.DrawConfiguration(FingerIndex{0}, random));
    const PlacedFinger other =
        scene.Place(FingerIndex{1}, scene.DrawConfiguration(FingerIndex{1}, random));
    count += static_cast<int>(scene.KeepApart(one, other));
  }
  return count;
}

/// The capsule of a fingertip contains the sphere, but not the plate.
TEST_F(HandSceneTest, FingersKeepClearOfTheCollisionGeometryOfFingertips) {
  const HandModel plain = HandWith("");
  const HandModel same = HandWith(R"(<geom size="0.009" pos="0 0 0.02"/>)");
  const HandModel wide = HandWith(R"(<geom type="box" size="0.02 0.02 0.004" pos="0 0 0.02"/>)");
  ASSERT_EQ(same.fingers[0].shapes.size(), plain.fingers[0].shapes.size() + 1);
  ASSERT_EQ(wide.fingers[0].shapes.size(), plain.fingers[0].shapes.size() + 1);
  const int apart = CountApart(plain);
  EXPECT_GT(apart, 100);
  EXPECT_EQ(CountApart(same), apart);
  EXPECT_LT(CountApart(wide), apart);
}

/// A sphere in the fingertip's body is as large as the fingertip sphere, and `ahead` of it. It is
/// therefore by `ahead` inside the object that the fingertip touches.
TEST_F(HandSceneTest, GeometryOfFingertipsIsShallowUpToAFractionOfTheRadius) {
  const object::Polyhedron cube = MakeCube(0.1);
  const collision::SurfaceTree surface(cube, 1);
  const auto is_shallow = [&](const std::string& ahead_mm, double inside) {
    const HandModel hand = HandWith(R"(<geom size="0.01" pos="0 0 )" + ahead_mm + R"("/>)");
    const HandScene scene(hand, surface, 1e-3);
    const kinematics::Finger& finger = hand.fingers[0];
    const JointConfiguration straight = JointConfiguration::Zero(finger.drives);
    const Eigen::Vector3d tip = kinematics::TipAt(finger, straight).centre;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = tip + Eigen::Vector3d(0, 0, finger.tip.radius + 0.1 - inside);
    return scene.IsShallow(scene.Place(FingerIndex{0}, straight), pose, Eigen::Vector3d::UnitZ());
  };
  EXPECT_TRUE(is_shallow("0.0275", 0));
  EXPECT_FALSE(is_shallow("0.0285", 0));
  // The fingertip's capsule contains the sphere, which therefore does not count.
  EXPECT_TRUE(is_shallow("0.024", 0.02));
}

}  // namespace hand_scene_test
}  // namespace regrasp::gait
