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

}  // namespace hand_scene_test
}  // namespace regrasp::gait
