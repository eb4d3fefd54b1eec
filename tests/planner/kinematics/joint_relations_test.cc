#include "planner/kinematics/joint_relations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <optional>

#include "planner/base/error.h"
#include "planner/base/random.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/inspect_hand.h"
#include "planner/kinematics/mujoco_model.h"
#include "tests/fixtures/folder_test.h"
#include "tests/planner/kinematics/ring_model.h"

namespace regrasp::kinematics {
namespace joint_relations_test {

using testing::HasSubstr;
using testing::IsEmpty;
using Couplings = std::vector<HandDescription::Coupling>;

class JointRelationsTest : public FolderTest {
 protected:
  InspectedHand Inspect(const RingParts& parts) const {
    return InspectHand(Write("ring.xml", RingXml(parts)));
  }
  Couplings CouplingsOf(const std::string& after, const std::string& joint3 = "") const {
    return Inspect({.after = after, .joint3 = joint3}).description.couplings;
  }
  std::string Refusal(const RingParts& parts) const {
    try {
      (void)Inspect(parts);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  }
  std::string Refusal(const std::string& after) const { return Refusal(RingParts{.after = after}); }
};

std::string Equality(const std::string& attributes) {
  return "<equality><joint " + attributes + "/></equality>";
}

void ExpectOne(const Couplings& couplings, double ratio, double offset) {
  ASSERT_EQ(couplings.size(), 1U);
  EXPECT_EQ(couplings[0].joint, "f3");
  EXPECT_EQ(couplings[0].follows, "f2");
  EXPECT_NEAR(couplings[0].ratio, ratio, 1e-12);
  EXPECT_NEAR(couplings[0].offset, offset, 1e-12);
}

TEST_F(JointRelationsTest, AModelWithoutConstraintsHasNone) {
  EXPECT_THAT(CouplingsOf(""), IsEmpty());
  EXPECT_THAT(CouplingsOf(Equality(R"(joint1="f3" joint2="f2" active="false")")), IsEmpty());
}

TEST_F(JointRelationsTest, ARatioWithAConstant) {
  ExpectOne(CouplingsOf(Equality(R"(joint1="f3" joint2="f2" polycoef="0.2 1.06 0 0 0")")), 1.06,
            0.2);
}

/// Constraints refer to angles relative to the reference configuration.
TEST_F(JointRelationsTest, ReferencePositionsAreAnOffset) {
  ExpectOne(
      CouplingsOf(Equality(R"(joint1="f3" joint2="f2" polycoef="0.1 1.5 0 0 0")"), R"(ref="0.3")"),
      1.5, 0.4);
  ExpectOne(CouplingsOf(Equality(R"(joint1="f2" joint2="f3" polycoef="0 2 0 0 0")") +
                            R"(<actuator><motor joint="f2"/></actuator>)",
                        R"(ref="0.3")"),
            0.5, 0.3);
}

TEST_F(JointRelationsTest, EqualTendonsAreALinearRelation) {
  // The relation is 2 f2 − f3 = 0.1, because the tendon's length is relative to the reference
  // configuration.
  ExpectOne(CouplingsOf(R"(<tendon><fixed name="t"><joint joint="f2" coef="2"/>
                           <joint joint="f3" coef="-1"/></fixed></tendon><equality><tendon
                           tendon1="t" polycoef="0.1 0 0 0 0"/></equality>)"),
            2, -0.1);
  // The relation is f3 = 3 f2, by two tendons with one joint each.
  ExpectOne(CouplingsOf(R"(<tendon><fixed name="t"><joint joint="f2" coef="1"/></fixed>
                           <fixed name="u"><joint joint="f3" coef="1"/></fixed></tendon><equality>
                           <tendon tendon1="u" tendon2="t" polycoef="0 3 0 0 0"/></equality>)"),
            3, 0);
}

TEST_F(JointRelationsTest, ChainsAreComposed) {
  const Couplings couplings = CouplingsOf(
      R"(<equality><joint joint1="f3" joint2="f2" polycoef="0.1 0.5 0 0 0"/>
         <joint joint1="f2" joint2="f1" polycoef="0.2 2 0 0 0"/></equality>)");
  ASSERT_EQ(couplings.size(), 2U);
  EXPECT_EQ(couplings[0].joint, "f2");
  EXPECT_EQ(couplings[1].joint, "f3");
  EXPECT_EQ(couplings[1].follows, "f1");
  EXPECT_NEAR(couplings[1].ratio, 1, 1e-12);
  EXPECT_NEAR(couplings[1].offset, 0.2, 1e-12);
}

TEST_F(JointRelationsTest, RelationsMustAgree) {
  const std::string once = R"(<joint joint1="f3" joint2="f2" polycoef="0 2 0 0 0"/>)";
  const auto both = [&](const std::string& other) {
    return "<equality>" + once + other + "</equality>";
  };
  EXPECT_EQ(Refusal(both(R"(<joint joint1="f2" joint2="f3" polycoef="0 0.5 0 0 0"/>)")), "taken");
  EXPECT_THAT(Refusal(both(R"(<joint joint1="f2" joint2="f3" polycoef="0 0.6 0 0 0"/>)")),
              HasSubstr("couples joints f2 and f3, expected one relation"));
  EXPECT_THAT(Refusal(both(R"(<joint joint1="f3" joint2="f2" polycoef="0.1 2 0 0 0"/>)")),
              HasSubstr("couples joints f3 and f2, expected one relation"));
}

TEST_F(JointRelationsTest, WhatNoRelationRepresentsIsRefusedByName) {
  EXPECT_THAT(Refusal(Equality(R"(joint1="f3" joint2="f2" polycoef="0 0.8 0.2 0 0")")),
              HasSubstr("ring.xml: equality constraint of joint f3: expected a linear relation, "
                        "found polycoef=\"0 0.8 0.2 0 0\""));
  EXPECT_THAT(Refusal(Equality(R"(joint1="f3" polycoef="0.3 0 0 0 0")")),
              HasSubstr("fixes joint f3"));
  EXPECT_THAT(Refusal(Equality(R"(joint1="f3" joint2="f2" polycoef="0.3 0 0 0 0")")),
              HasSubstr("fixes joint f3"));
  EXPECT_THAT(Refusal(Equality(R"(joint1="g3" joint2="f2")")),
              HasSubstr("couples joints g3 and f2, expected two joints of one finger, found joints "
                        "of two fingers"));
  EXPECT_THAT(Refusal(Equality(R"(joint1="f3" joint2="knob1")")),
              HasSubstr("couples joints f3 and knob1, expected two joints of one finger, found a "
                        "joint outside the fingers"));
  EXPECT_EQ(Refusal(Equality(R"(joint1="knob1" polycoef="0.3 0 0 0 0")")), "taken")
      << "it has no part in a finger";
}

TEST_F(JointRelationsTest, TendonsThatNoRelationRepresentsAreRefusedByName) {
  const std::string three = R"(<tendon><fixed name="t"><joint joint="f1" coef="1"/>
      <joint joint="f2" coef="1"/><joint joint="f3" coef="1"/></fixed></tendon>)";
  EXPECT_THAT(Refusal(three + R"(<equality><tendon tendon1="t"/></equality>)"),
              HasSubstr("couples joints f1, f2, f3, expected two joints"));
  const std::string across = R"(<tendon><fixed name="t"><joint joint="f2" coef="1"/>
      <joint joint="g2" coef="1"/></fixed></tendon>)";
  EXPECT_THAT(Refusal(across + R"(<actuator><motor name="m" tendon="t"/></actuator>)"),
              HasSubstr("tendon t of actuator m: couples joints g2 and f2, expected two joints of "
                        "one finger"));
  const std::string cable = R"(<tendon><spatial name="t"><site site="end"/><site site="foot"/>
      </spatial></tendon>)";
  RingParts parts;
  parts.palm += "<site name=\"foot\"/><body name=\"z\" pos=\"0 0 0.2\"><site name=\"end\"/></body>";
  parts.after = cable + R"(<actuator><motor tendon="t"/></actuator>)";
  EXPECT_EQ(Refusal(parts), "taken") << "a cable that moves no finger";
  std::string xml = RingXml(parts);
  const std::string tip = "<body name=\"fc\" pos=\"0 0 0.032\">";
  xml.replace(xml.find("<site name=\"end\"/>"), 18, "");
  xml.insert(xml.find(tip) + tip.size(), "<site name=\"end\"/>");
  try {
    (void)InspectHand(Write("cable.xml", xml));
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("joints f1, f2, f3: moved by a spatial tendon"));
  }
}

TEST_F(JointRelationsTest, LimitsOfTendonsAreRefusedByName) {
  const auto tendon = [](const std::string& range, const std::string& second) {
    return "<tendon><fixed name=\"t\" " + range +
           R"(><joint joint="f2" coef="0.007"/><joint joint=")" + second +
           R"(" coef="-0.008"/></fixed></tendon>)";
  };
  EXPECT_THAT(Refusal(tendon("range=\"-0.001 0.001\"", "f3")),
              HasSubstr("joints f2, f3: limited by a tendon, expected joints with limits of their "
                        "own, found the range of tendon t"));
  EXPECT_THAT(Refusal(tendon("range=\"-0.001 0.001\"", "knob1")), HasSubstr("joint f2: limited"));
  EXPECT_EQ(Refusal(tendon("", "f3")), "taken") << "a tendon without a range imposes nothing";
}

TEST_F(JointRelationsTest, ClosedLoopsAreRefusedByName) {
  EXPECT_THAT(Refusal(R"(<equality><connect body1="fb" body2="knob" anchor="0 0 0"/></equality>)"),
              HasSubstr("joints f1, f2: part of a closed loop, expected fingers that are open "
                        "chains of joints, found <connect> of bodies fb and knob"));
  EXPECT_THAT(Refusal(R"(<equality><weld body1="gc" body2="hc"/></equality>)"),
              HasSubstr("joints g1, g2, g3, h1, h2, h3: part of a closed loop"));
  EXPECT_THAT(Refusal(R"(<equality><connect body1="fa" anchor="0 0 0"/></equality>)"),
              HasSubstr("joint f1: part of a closed loop"));
  EXPECT_EQ(Refusal(R"(<equality><weld body1="palm"/></equality>)"), "taken")
      << "what holds the palm moves no finger";
  EXPECT_EQ(Refusal(R"(<equality><connect body1="fa" anchor="0 0 0" active="false"/></equality>)"),
            "taken");
}

TEST_F(JointRelationsTest, AHandFileMustHaveTheCouplingsOfItsModel) {
  const RingParts parts{.after = Equality(R"(joint1="f3" joint2="f2" polycoef="0.2 1.06 0 0 0")")};
  HandDescription description = Inspect(parts).description;
  const auto read = [&]() -> std::string {
    Write("hand.json", FormatHandDescription(description));
    try {
      (void)ReadHand(folder_ / "hand.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(read(), "taken");
  description.couplings[0].offset = 0;
  EXPECT_THAT(read(),
              HasSubstr("expected ratio 1.06 and offset 0.2, found ratio 1.06 and offset 0"));
  description.couplings[0].offset = 0.2;
  description.couplings[0].ratio = 1;
  EXPECT_THAT(read(),
              HasSubstr("hand.json: /couplings: joints f3 and f2 are coupled in the model"));
  description.couplings.clear();
  EXPECT_THAT(read(), HasSubstr("expected a coupling with ratio 1.06 and offset 0.2, found none"));
  description.couplings = {{"f3", "f2", 1.06, 0.2}, {"g33", "g2", 1, 0}};
  EXPECT_THAT(read(), HasSubstr("/couplings/1/joint: expected a joint of a finger, found \"g33\""));
  description.couplings[1] = {"f3", "f2", 1.06, 0.2};
  EXPECT_THAT(read(), HasSubstr("joint f3 must be coupled once, found twice"));
  description.couplings[1] = {"g3", "g2", 1, 0};
  EXPECT_EQ(read(), "taken") << "a file may couple more than its model";
}

TEST_F(JointRelationsTest, AHandFileMustCoupleWhatSharesAnActuator) {
  HandDescription description =
      Inspect({.after = R"(<tendon><fixed name="t"><joint joint="f2" coef="1"/>
               <joint joint="f3" coef="1"/></fixed></tendon><actuator><motor tendon="t"/>
               </actuator>)"})
          .description;
  ASSERT_EQ(description.couplings.size(), 1U);
  description.couplings[0].ratio = 0.7;
  Write("hand.json", FormatHandDescription(description));
  EXPECT_NO_THROW((void)ReadHand(folder_ / "hand.json")) << "the ratio is the real hand's";
  description.couplings.clear();
  Write("hand.json", FormatHandDescription(description));
  EXPECT_THROW((void)ReadHand(folder_ / "hand.json"), InputError);
}

/// MuJoCo's kinematics with joints that satisfy the constraint are the independent reference.
TEST_F(JointRelationsTest, CoupledFingersMoveAsTheEngineHasThem) {
  const std::string path =
      Write("ring.xml",
            RingXml({.after = Equality(R"(joint1="f3" joint2="f2" polycoef="0.2 1.06 0 0 0")"),
                     .joint3 = R"(ref="0.1")"}))
          .string();
  const HandModel hand = InspectHand(path).hand;
  const Finger& finger = hand.fingers[0];
  ASSERT_EQ(finger.drives, 2);
  EXPECT_EQ(LeadingJoint(finger, 1).name, "f2");
  const CompiledModel compiled = CompileModel(path);
  const mjModel& model = *compiled.model;
  const DataPtr data = AtRest(model);
  RandomStream random(1, RandomUse::kCandidates);
  for (int i = 0; i < 20; ++i) {
    JointConfiguration configuration = finger.lower;
    for (int k = 0; k < 2; ++k)
      configuration[k] += (finger.upper - finger.lower)[k] * random.Uniform();
    const std::vector<double> angles = JointAngles(finger, configuration);
    EXPECT_NEAR(angles[2], 0.1 + 0.2 + 1.06 * angles[1], 1e-12);
    EXPECT_NEAR(DriveAngle(finger.joints[2], angles[2]), configuration[1], 1e-12);
    EXPECT_GE(angles[2], -0.5 - 1e-12);
    EXPECT_LE(angles[2], 1.6 + 1e-12);
    for (int k = 0; k < 3; ++k) {
      const int id = mj_name2id(&model, mjOBJ_JOINT, finger.joints[k].name.c_str());
      data->qpos[model.jnt_qposadr[id]] = angles[k];
    }
    mj_kinematics(&model, data.get());
    const int tip = mj_name2id(&model, mjOBJ_BODY, "fc");
    const int palm = mj_name2id(&model, mjOBJ_BODY, "palm");
    const Eigen::Vector3d expected =
        PoseAt(data->xpos, data->xmat, palm).inverse() *
        (PoseAt(data->xpos, data->xmat, tip) * Eigen::Vector3d(0, 0, 0.024));
    EXPECT_LT((TipAt(finger, configuration).centre - expected).norm(), 1e-9);
  }
}

/// Return three fingers as in RingXml, as a URDF model.
std::string RingUrdf(const std::string& limit, const std::string& mimic) {
  const std::string inertial =
      R"(<inertial><mass value="0.02"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0"
      iyz="0"/></inertial>)";
  std::string text = "<robot name=\"ring\"><link name=\"palm\">" + inertial +
                     R"(<collision><origin xyz="0 0 -0.02"/><geometry><cylinder radius="0.07"
                     length="0.02"/></geometry></collision></link>)";
  for (const std::string name : {"f", "g", "h"}) {
    std::string parent = "palm";
    const std::string place = name == "f"   ? "0.06 0 0"
                              : name == "g" ? "-0.03 0.05 0"
                                            : "-0.03 -0.05 0";
    for (const std::string part : {"1", "2", "3"}) {
      const std::string joint = name + part;
      text += "<link name=\"" + joint + "link\">" + inertial +
              R"(<collision><origin xyz="0 0 0.03"/><geometry><sphere radius="0.01"/></geometry>
              </collision></link><joint name=")" +
              joint + "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" +
              joint + "link\"/><origin xyz=\"" + (part == "1" ? place : "0 0 0.04") +
              "\"/><axis xyz=\"0 1 0\"/><limit lower=\"-0.5\" upper=\"1.5\" velocity=\"6\" " +
              limit + "/>" + (joint == "f3" ? mimic : "") + "</joint>";
      parent = joint + "link";
    }
  }
  return text + "</robot>";
}

TEST_F(JointRelationsTest, MimicsOfAUrdfAreCouplingsOrRefused) {
  const auto refusal = [&](const std::string& mimic) -> std::string {
    try {
      (void)InspectHand(Write("ring.urdf", RingUrdf("effort=\"1\"", mimic)));
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  const auto path =
      Write("ring.urdf",
            RingUrdf("effort=\"1\"", R"(<mimic joint="f2" multiplier="1.1169" offset="-0.15"/>)"));
  const InspectedHand inspected = InspectHand(path);
  ExpectOne(inspected.description.couplings, 1.1169, -0.15);
  EXPECT_THAT(InspectionText(inspected), HasSubstr("1.117 × f2 − 0.15 rad"));
  EXPECT_THAT(refusal(R"(<mimic joint="f2" multiplier="0"/>)"),
              HasSubstr("<mimic> of joint f3: fixes joint f3"));
  EXPECT_THAT(refusal(R"(<mimic joint="f22"/>)"),
              HasSubstr("<mimic> of joint f3: expected a joint that moves, found \"f22\""));
  EXPECT_THAT(refusal(R"(<mimic joint="g2"/>)"), HasSubstr("found joints of two fingers"));
  EXPECT_THAT(refusal(R"(<mimic joint="f3"/>)"), HasSubstr("of joint f3: expected another joint"));
  EXPECT_EQ(refusal(R"(<mimic joint="f1"/>)"), "taken");
}

TEST_F(JointRelationsTest, AnUnknownStrengthIsNoted) {
  const auto notes = [&](const std::string& limit) {
    return InspectHand(Write("ring.urdf", RingUrdf(limit, ""))).notes;
  };
  const std::string unknown =
      "force limit of joints f1, f2, f3, g1, g2, g3 and 3 more "
      "unknown, treated as unlimited";
  EXPECT_THAT(notes("effort=\"1\""), testing::Not(testing::Contains(unknown)));
  EXPECT_THAT(notes("effort=\" 1.0\""), testing::Not(testing::Contains(unknown)));
  EXPECT_THAT(notes("effort=\"0\""), testing::Contains(unknown));
  EXPECT_THAT(notes(""), testing::Contains(unknown));
  const auto servos = [&](const std::string& attributes) {
    std::string actuators;
    for (const std::string name : {"f", "g", "h"}) {
      for (const std::string part : {"1", "2", "3"}) {
        if (name + part == "g2" && attributes.empty()) continue;
        actuators += "<position joint=\"" + name + part + "\" " + attributes + "/>";
      }
    }
    return Inspect({.after = "<actuator>" + actuators + "</actuator>"}).notes;
  };
  EXPECT_THAT(servos("forcerange=\"-1 1\""), IsEmpty());
  EXPECT_THAT(servos("ctrlrange=\"-1 1\""), testing::Contains(unknown)) << "a range of angles";
  EXPECT_THAT(servos(""), testing::Contains("joint g2 has no actuator: plans are not simulated"));
  EXPECT_THAT(Inspect({}).notes,
              testing::Contains("the model has no actuators: plans are not simulated"));
}

}  // namespace joint_relations_test
}  // namespace regrasp::kinematics
