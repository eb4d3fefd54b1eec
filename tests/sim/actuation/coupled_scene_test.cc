#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <string>

#include "planner/base/error.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/inspect_hand.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/object.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_world.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"
#include "tests/planner/kinematics/ring_model.h"

namespace regrasp::sim {
namespace coupled_scene_test {

using testing::HasSubstr;

class CoupledSceneTest : public FolderTest {
 protected:
  kinematics::HandFile Hand(const kinematics::RingParts& parts) const {
    const auto model = Write("ring.xml", kinematics::RingXml(parts));
    const kinematics::HandDescription description = kinematics::InspectHand(model).description;
    return kinematics::ReadHandFile(
        Write("ring.json", kinematics::FormatHandDescription(description)));
  }
  static const object::Polyhedron& Cube() {
    static const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
    return dynamic_cast<const object::Polyhedron&>(*file.object);
  }
};

std::string Servos(const std::string& joints) {
  std::string actuators = "<actuator>";
  for (const std::string finger : {"f", "g", "h"}) {
    for (const char joint : joints) {
      actuators += "<position joint=\"" + finger + joint + "\" kp=\"2\" forcerange=\"-1 1\"/>";
    }
  }
  return actuators + "</actuator>";
}

std::string CoupleAll(const std::string& follower, const std::string& leader,
                      const std::string& polynomial) {
  std::string equalities = "<equality>";
  for (const std::string finger : {"f", "g", "h"}) {
    equalities += "<joint joint1=\"" + finger + follower + "\" joint2=\"" + finger + leader +
                  "\" polycoef=\"" + polynomial + "\"/>";
  }
  return equalities + "</equality>";
}

/// At the angles of the coupling, all constraints of the scene, from the model and from the file,
/// are satisfied.
TEST_F(CoupledSceneTest, ConstraintsAreThoseOfTheCoupling) {
  const kinematics::HandFile hand = Hand(
      {.after = CoupleAll("3", "2", "0.2 1.06 0 0 0") + Servos("12"), .joint3 = R"(ref="0.3")"});
  const kinematics::ModelPtr model =
      kinematics::CompileText(folder_ / "ring.xml", HandSceneText(hand, Cube(), 0.05, 0.1));
  EXPECT_EQ(model->neq, 6);
  for (int i = 0; i < model->neq; ++i) {
    const int joint = model->eq_obj1id[i];
    const int leader = model->eq_obj2id[i];
    const double rest = model->qpos0[model->jnt_qposadr[joint]];
    const double leader_rest = model->qpos0[model->jnt_qposadr[leader]];
    const mjtNum* polynomial = model->eq_data + mjNEQDATA * i;
    const double angle = rest + polynomial[0] + polynomial[1] * (0.5 - leader_rest);
    EXPECT_NEAR(angle, 0.3 + 0.2 + 1.06 * 0.5, 1e-12);
  }
}

TEST_F(CoupledSceneTest, AFollowersOwnActuatorIsLeftOut) {
  const auto actuators = [&](const std::string& joints) {
    const kinematics::HandFile hand =
        Hand({.after = CoupleAll("3", "2", "0.2 1.06 0 0 0") + Servos(joints)});
    return kinematics::CompileText(folder_ / "ring.xml", HandSceneText(hand, Cube(), 0.05, 0.1))
        ->nu;
  };
  EXPECT_EQ(actuators("123"), 6);
  EXPECT_EQ(actuators("12"), 6);
  EXPECT_EQ(actuators("13"), 6) << "joint 3 leads";
}

TEST_F(CoupledSceneTest, AJointWithoutAnActuatorIsNamed) {
  const kinematics::HandFile hand =
      Hand({.after = CoupleAll("2", "1", "0 0.9 0 0 0") + Servos("1")});
  try {
    const HandWorld world(hand, Cube(), 0.05, {.mu = 0.8, .mass_kg = 0.1});
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("actuator of joint f3 not found"));
  }
  EXPECT_THAT(hand.warnings,
              testing::ElementsAre("joints f3, g3, h3 have no actuator: plans are not simulated"));
  const kinematics::HandFile whole =
      Hand({.after = CoupleAll("2", "1", "0 0.9 0 0 0") + Servos("13")});
  EXPECT_NO_THROW(HandWorld(whole, Cube(), 0.05, {.mu = 0.8, .mass_kg = 0.1}));
  EXPECT_TRUE(whole.warnings.empty());
}

}  // namespace coupled_scene_test
}  // namespace regrasp::sim
