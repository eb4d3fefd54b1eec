#include "planner/kinematics/derive_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "planner/base/error.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/inspect_hand.h"
#include "planner/kinematics/mujoco_model.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::kinematics {
namespace derive_hand_test {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHands = ProjectPath("models/hands/");

class DeriveHandTest : public FolderTest {
 protected:
  DerivedHand Derive(const std::string& xml) const {
    return DeriveHand(CompileModel(Write("model.xml", xml)), "model.xml");
  }
};

/// Return two links of a finger along z that flexes towards +y; the distal link is a capsule.
std::string FingerXml(const std::string& name, const std::string& place,
                      const std::string& inside = "") {
  return "<body name=\"rh_" + name + "proximal\" " + place + "><joint name=\"" + name +
         "1\" axis=\"-1 0 0\" range=\"-10 90\"/><geom type=\"capsule\" size=\"0.008\" "
         "fromto=\"0 0 0 0 0 0.04\"/><body name=\"rh_" +
         name + "distal\" pos=\"0 0 0.04\"><joint name=\"" + name +
         "2\" axis=\"-1 0 0\" range=\"0 90\"/><geom type=\"capsule\" size=\"0.007\" "
         "fromto=\"0 0 0 0 0 0.02\"/>" +
         inside + "</body></body>";
}

/// Return a link of an arm with a palm, three fingers along z and a thumb in another direction.
std::string Hand(const std::string& rest = "", const std::string& inside = "") {
  return R"(<mujoco model="test"><compiler autolimits="true"/><worldbody><body name="arm">
    <joint name="wrist" axis="0 0 1" range="-90 90"/><geom type="sphere" size="0.03"/>
    <body name="palm" pos="0 0 0.05"><geom type="box" size="0.04 0.01 0.04"/>
    <body name="plate"><geom type="box" size="0.01 0.02 0.01"/></body>)" +
         FingerXml("ff", "pos=\"-0.03 0 0.05\"", inside) + FingerXml("mf", "pos=\"0 0 0.05\"") +
         FingerXml("rf", "pos=\"0.03 0 0.05\"") +
         FingerXml("th", "pos=\"-0.05 0 0\" euler=\"0 -90 40\"") + "</body></body></worldbody>" +
         rest + "</mujoco>";
}

TEST_F(DeriveHandTest, FindsPalmTipsBallsNamesAndUp) {
  const DerivedHand derived = Derive(Hand());
  const HandDescription& hand = derived.description;
  EXPECT_EQ(hand.name, "test");
  EXPECT_EQ(hand.palm, "palm");
  EXPECT_EQ(hand.up, Vector3d::UnitY());
  ASSERT_EQ(hand.tips.size(), 4U);
  std::vector<std::string> names;
  for (const auto& tip : hand.tips) {
    names.push_back(tip.name);
    EXPECT_EQ(tip.body, "rh_" + tip.name + "distal");
    EXPECT_EQ(tip.radius, 0.007);
    EXPECT_LT((tip.centre - Vector3d(0, 0, 0.02)).norm(), 1e-9);
  }
  EXPECT_THAT(names, ElementsAre("ff", "mf", "rf", "th"));
  EXPECT_THAT(hand.couplings, IsEmpty());
  EXPECT_THAT(derived.notes, IsEmpty());
}

TEST_F(DeriveHandTest, ALinkBesideAFingerIsNoFinger) {
  const DerivedHand derived =
      Derive(Hand("",
                  "<body name=\"sensor\" pos=\"0.02 0 0\"><joint name=\"press\" range=\"0 1\"/>"
                  "<geom size=\"0.003\"/></body>"
                  "<body name=\"nail\" pos=\"0 0 0.02\"><joint name=\"loose\" range=\"0 10\"/>"
                  "<geom size=\"0.003\"/></body>"));
  ASSERT_EQ(derived.description.tips.size(), 4U);
  EXPECT_EQ(derived.description.tips[0].body, "sensor") << "the first of equal chains";
  EXPECT_THAT(derived.notes, Contains(HasSubstr("body nail is not used as a fingertip")));
}

TEST_F(DeriveHandTest, EqualitiesCoupleAndTheJointWithAnActuatorLeads) {
  const DerivedHand derived = Derive(Hand(
      R"(<equality><joint joint1="ff1" joint2="ff2" polycoef="0 1.25 0 0 0"/>
         <joint joint1="mf2" joint2="mf1" polycoef="0 0.5 0 0 0"/>
         <joint joint1="rf2" joint2="rf1" polycoef="0.1 0.5 0 0 0"/></equality>
         <actuator><position joint="ff1"/><position joint="mf1"/></actuator>)"));
  const auto& couplings = derived.description.couplings;
  ASSERT_EQ(couplings.size(), 3U);
  EXPECT_EQ(couplings[0].joint, "ff2");
  EXPECT_EQ(couplings[0].follows, "ff1");
  EXPECT_NEAR(couplings[0].ratio, 0.8, 1e-12);
  EXPECT_EQ(couplings[1].joint, "mf2");
  EXPECT_EQ(couplings[1].ratio, 0.5);
  EXPECT_EQ(couplings[2].joint, "rf2");
  EXPECT_EQ(couplings[2].ratio, 0.5);
  EXPECT_NEAR(couplings[2].offset, 0.1, 1e-12);
}

TEST_F(DeriveHandTest, ATendonOfOneActuatorCouplesWhatItPulls) {
  const DerivedHand derived = Derive(Hand(
      R"(<tendon><fixed name="t"><joint joint="ff1" coef="2"/><joint joint="ff2" coef="1"/></fixed>
         </tendon><actuator><position tendon="t"/></actuator>)"));
  const auto& couplings = derived.description.couplings;
  ASSERT_EQ(couplings.size(), 1U);
  EXPECT_EQ(couplings[0].joint, "ff2");
  EXPECT_EQ(couplings[0].follows, "ff1");
  EXPECT_EQ(couplings[0].ratio, 0.5);
  EXPECT_THAT(derived.notes, Contains(HasSubstr("share an actuator by a tendon")));
}

/// Bodies without a joint between them are one link, wherever a marker is on it.
TEST_F(DeriveHandTest, AMarkerFixedToALinkIsNoFingertip) {
  for (const std::string place : {"0.02", "0.0265", "0.0275"}) {
    const DerivedHand derived = Derive(
        Hand("", "<body name=\"mark\" pos=\"0 0 " + place + "\"><geom size=\"0.0002\"/></body>"));
    const HandDescription::Tip& tip = derived.description.tips[0];
    EXPECT_EQ(tip.body, "rh_ffdistal");
    EXPECT_EQ(tip.name, "ff");
    EXPECT_EQ(tip.radius, 0.007);
  }
  // A sphere at the end of a much larger box.
  const auto at_end_of_box = [&](const std::string& radius) {
    return Derive(Hand("", R"(<geom type="box" size="0.007 0.007 0.03" pos="0 0 0.02"/>
                              <body name="mark" pos="0 0 0.05"><geom size=")" +
                               radius + "\"/></body>"))
        .description.tips[0];
  };
  EXPECT_EQ(at_end_of_box("0.002").body, "rh_ffdistal");
  EXPECT_EQ(at_end_of_box("0.006").body, "mark");
  const DerivedHand pad =
      Derive(Hand("", "<body name=\"pad\" pos=\"0 0 0.03\"><geom size=\"0.005\"/></body>"));
  EXPECT_EQ(pad.description.tips[0].body, "pad") << "a part that reaches farther is the tip";
  EXPECT_EQ(pad.description.tips[0].radius, 0.005);
}

TEST_F(DeriveHandTest, WhatIsNoHandIsRefused) {
  const auto refusal = [&](const std::string& xml) -> std::string {
    try {
      (void)Derive(xml);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal("<mujoco><worldbody><geom size=\"1\"/></worldbody></mujoco>"),
              HasSubstr("model.xml: found 0 fingers"));
  EXPECT_THAT(
      refusal(
          "<mujoco><compiler autolimits=\"true\"/><worldbody><body name=\"p\"><geom size=\"1\"/>" +
          FingerXml("a", "") + FingerXml("b", "") + "</body></worldbody></mujoco>"),
      HasSubstr("found 2 fingers"));
}

/// The derived descriptions of the project's hands equal their files.
TEST_F(DeriveHandTest, RingHandsAreWhatTheirFilesSay) {
  for (const std::string name : {"ring4", "ring5"}) {
    const InspectedHand derived = InspectHand(kHands + name + ".xml");
    const InspectedHand read = InspectHand(kHands + name + ".json");
    EXPECT_EQ(FormatHandDescription(derived.description), FormatHandDescription(read.description));
    EXPECT_THAT(derived.notes, IsEmpty());
    EXPECT_THAT(derived.conversions, IsEmpty());
    EXPECT_EQ(InspectionText(derived).find("converted"), std::string::npos);
  }
}

TEST(InspectHandTest, TheLargestReachIsThatOfAStraightFinger) {
  Finger finger;
  for (int i = 0; i < 3; ++i) {
    Joint joint;
    joint.offset = Vector3d(0, 0, i == 0 ? 0 : 0.05);
    joint.axis = Vector3d::UnitX();
    joint.drive = i;
    finger.joints.push_back(joint);
  }
  finger.drives = 3;
  finger.tip.centre = Vector3d(0, 0, 0.03);
  finger.lower = Eigen::Vector3d(-1, -0.3, -0.5);
  finger.upper = Eigen::Vector3d(1, 1, 0.9);
  EXPECT_NEAR(LargestReach(finger), 0.13, 1e-5);
  EXPECT_LE(LargestReach(finger), 0.13 + 1e-12);
}

/// Third-party models are not part of the project. They are in the folder REGRASP_HANDS or next to
/// the project.
TEST(InspectHandTest, HandsOfOthersAreUnderstood) {
  const char* given = std::getenv("REGRASP_HANDS");
  const fs::path folder = given != nullptr ? fs::path(given) : ProjectPath("../shared/hands");
  if (!fs::exists(folder / "wonik_allegro")) GTEST_SKIP() << "no hands of others";
  const InspectedHand allegro = InspectHand(folder / "wonik_allegro/right_hand.xml");
  EXPECT_EQ(allegro.description.palm, "palm");
  EXPECT_EQ(allegro.description.up, Vector3d::UnitX());
  for (const HandDescription::Tip& tip : allegro.description.tips) {
    EXPECT_NEAR(tip.radius, 0.012, 1e-6);
    EXPECT_NEAR((tip.centre - Vector3d(0, 0, tip.name == "th" ? 0.043 : 0.029)).norm(), 0, 1e-5);
  }
  const InspectedHand shadow = InspectHand(folder / "shadow_hand/right_hand.xml");
  EXPECT_EQ(shadow.description.palm, "rh_palm");
  EXPECT_EQ(shadow.description.up, -Vector3d::UnitY());
  ASSERT_EQ(shadow.description.couplings.size(), 4U);
  for (const HandDescription::Coupling& coupling : shadow.description.couplings) {
    EXPECT_EQ(coupling.ratio, 1);
    EXPECT_TRUE(coupling.joint.ends_with("J1") && coupling.follows.ends_with("J2"));
  }
  const InspectedHand leap = InspectHand(folder / "leap_hand/leap_hand_right.urdf");
  EXPECT_EQ(leap.description.palm, "palm_lower");
  EXPECT_EQ(leap.description.tips.size(), 4U);
}

}  // namespace derive_hand_test
}  // namespace regrasp::kinematics
