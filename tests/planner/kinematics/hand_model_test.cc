#include "planner/kinematics/hand_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/inspect_hand.h"
#include "tests/fixtures/folder_test.h"
#include "tests/planner/kinematics/ring_model.h"

namespace regrasp::kinematics {
namespace hand_description_test {

Json GoodJson() {
  return ParseJson(R"({"format": "regrasp-hand", "version": 1, "name": "claw", "model": "claw.xml",
    "palm": "palm", "up": [0, 0, 2], "fingers": [
    {"name": "a", "tip": {"body": "tip_a", "centre": [0, 0, 0.01], "radius": 0.01}},
    {"name": "b", "tip": {"body": "tip_b", "centre": [0, 0, 0.01], "radius": 0.01}},
    {"name": "c", "tip": {"body": "tip_c", "centre": [0, 0, 0.01], "radius": 0.01}}],
    "couplings": [{"joint": "a2", "follows": "a1", "ratio": 0.5},
                  {"joint": "b2", "follows": "b1", "ratio": 2, "offset": -0.15}]})",
                   "good");
}

TEST(HandDescriptionTest, WhatIsWrittenIsReadAgain) {
  const HandDescription description = ParseHandDescription(FormatJson(GoodJson()), "claw.json");
  EXPECT_EQ(description.name, "claw");
  EXPECT_EQ(description.up, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(description.tips.size(), 3U);
  EXPECT_EQ(description.couplings.front().ratio, 0.5);
  EXPECT_EQ(description.couplings.front().offset, 0);
  EXPECT_EQ(description.couplings.back().offset, -0.15);
  const std::string text = FormatHandDescription(description);
  EXPECT_EQ(FormatHandDescription(ParseHandDescription(text, "again")), text);
}

TEST(HandDescriptionTest, WhatIsWrongIsNamed) {
  const auto expect_fails = [](const std::string& words, const auto& change) {
    Json json = GoodJson();
    change(json);
    try {
      (void)ParseHandDescription(FormatJson(json), "claw.json");
      ADD_FAILURE() << "taken, though: " << words;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
  };
  expect_fails("/fingers: expected at least 3", [](Json& json) { json["fingers"].erase(0); });
  expect_fails("names of fingers must be unique, found a twice",
               [](Json& json) { json["fingers"][1]["name"] = "a"; });
  expect_fails("must have different fingertips",
               [](Json& json) { json["fingers"][1]["tip"]["body"] = "tip_a"; });
  expect_fails("/fingers/0/tip/radius",
               [](Json& json) { json["fingers"][0]["tip"]["radius"] = 0; });
  expect_fails("/up: expected a direction", [](Json& json) { json["up"] = {0, 0, 0}; });
  expect_fails("/couplings/0/ratio", [](Json& json) { json["couplings"][0]["ratio"] = 0; });
  expect_fails("/couplings/1/offset", [](Json& json) { json["couplings"][1]["offset"] = "x"; });
  expect_fails("/palm", [](Json& json) { json["palm"] = ""; });
  expect_fails("format", [](Json& json) { json["format"] = "regrasp-plan"; });
}

}  // namespace hand_description_test

namespace check_model_test {

using testing::HasSubstr;

class CheckModelTest : public FolderTest {
 protected:
  std::string Refusal(const RingParts& parts) const {
    return RefusalOf(Write("ring.xml", RingXml(parts)));
  }
  static std::string RefusalOf(const std::filesystem::path& path) {
    try {
      (void)InspectHand(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  }
  std::string FileRefusal(const HandDescription& description) const {
    return RefusalOf(Write("hand.json", FormatHandDescription(description)));
  }
};

TEST_F(CheckModelTest, FlagsThatTurnOffPhysicsAreRefused) {
  for (const std::string flag : {"constraint", "equality", "frictionloss", "limit", "contact",
                                 "passive", "gravity", "clampctrl", "actuation"}) {
    EXPECT_THAT(Refusal({.before = "<option><flag " + flag + "=\"disable\"/></option>"}),
                HasSubstr("ring.xml: <flag> " + flag + ": not supported"));
  }
  EXPECT_THAT(Refusal({.before = R"(<option><flag override="enable"/></option>)"}),
              HasSubstr("<flag> override: not supported"));
  for (const std::string flag :
       {"warmstart=\"disable\"", "filterparent=\"disable\"", "refsafe=\"disable\"",
        "energy=\"enable\"", "gravity=\"enable\""}) {
    EXPECT_EQ(Refusal({.before = "<option><flag " + flag + "/></option>"}), "taken") << flag;
  }
}

TEST_F(CheckModelTest, MediaThatPushTheObjectAreRefused) {
  EXPECT_THAT(Refusal({.before = R"(<option wind="0 0 5"/>)"}),
              HasSubstr("<option> wind: not supported, expected 0, found 5"));
  EXPECT_THAT(Refusal({.before = R"(<option density="1000"/>)"}), HasSubstr("<option> density"));
  EXPECT_THAT(Refusal({.before = R"(<option viscosity="0.001"/>)"}),
              HasSubstr("<option> viscosity"));
  EXPECT_EQ(Refusal({.before = R"(<option timestep="0.001" cone="elliptic" impratio="10"
                                    gravity="0 0 -1" density="0"/>)"}),
            "taken");
}

TEST_F(CheckModelTest, ActuatorsThatMoveNoJointAreRefused) {
  EXPECT_THAT(
      Refusal({.after = R"(<actuator><adhesion name="glue" body="fc" ctrlrange="0 1"/>
                                   </actuator>)"}),
      HasSubstr("glue: moves no joint, expected actuators of joints or fixed tendons, found "
                "adhesion of a body"));
  RingParts parts{.after = R"(<actuator><general name="push" site="s"/></actuator>)"};
  parts.palm += "<site name=\"s\"/>";
  EXPECT_THAT(Refusal(parts), HasSubstr("push: moves no joint"));
  EXPECT_EQ(Refusal({.after = R"(<actuator><motor joint="f1"/></actuator>)"}), "taken");
}

TEST_F(CheckModelTest, PalmAndFingertipsNeedCollisionGeoms) {
  const std::filesystem::path path = Write("ring.xml", RingXml());
  HandDescription description = InspectHand(path).description;
  EXPECT_EQ(FileRefusal(description), "taken");
  const std::string off = R"(contype="0" conaffinity="0")";
  Write("ring.xml", RingXml({.geoms = off}));
  EXPECT_THAT(FileRefusal(description),
              HasSubstr("hand.json: /fingers/0/tip: body fc has no geom that collides"));
  EXPECT_THAT(RefusalOf(path), HasSubstr("found 0 fingers"));
  Write("ring.xml", RingXml({.palm = R"(<geom type="cylinder" size="0.07 0.01" )" + off + "/>"}));
  EXPECT_THAT(FileRefusal(description), HasSubstr("/palm: body palm has no geom that collides"));
  EXPECT_THAT(RefusalOf(path), HasSubstr("/palm: body palm has no geom that collides"));
  Write("ring.xml", RingXml({.palm = R"(<body name="shell"><geom size="0.02"/></body>)"}));
  EXPECT_EQ(FileRefusal(description), "taken") << "a body fixed to the palm is part of it";
}

TEST_F(CheckModelTest, AFingertipSphereIsAtItsLink) {
  HandDescription description = InspectHand(Write("ring.xml", RingXml())).description;
  const auto refusal = [&](const Eigen::Vector3d& centre, double radius) {
    description.tips[1].centre = centre;
    description.tips[1].radius = radius;
    return FileRefusal(description);
  };
  EXPECT_EQ(refusal({0, 0, 0.024}, 0.01), "taken");
  EXPECT_EQ(refusal({0, 0, 0.028}, 0.01), "taken");
  EXPECT_EQ(refusal({0, 0, 0.024}, 0.0145), "taken");
  EXPECT_THAT(
      refusal({0, 0, 0.0642}, 0.01),
      HasSubstr("/fingers/1/tip: the fingertip sphere reaches 40.2 mm beyond the link of body "
                "gc, limit 5 mm"));
  EXPECT_THAT(refusal({0, 0.06, 0.024}, 0.01), HasSubstr("beyond the link of body gc"));
  EXPECT_THAT(refusal({0.016, 0, 0.024}, 0.01), HasSubstr("beyond the link of body gc"));
  EXPECT_THAT(refusal({0, 0, 0.024}, 0.04), HasSubstr("reaches 30 mm beyond"));
}

/// A marker inside the fingertip sphere is part of it: neither the planner nor the check keeps it
/// away from objects.
TEST_F(CheckModelTest, AMarkerInsideTheFingertipIsPartOfIt) {
  const auto shapes = [&](const std::string& inside) {
    return InspectHand(Write("ring.xml", RingXml({.inside = inside})))
        .hand.fingers[0]
        .shapes.size();
  };
  const std::size_t plain = shapes("");
  EXPECT_EQ(shapes(R"(<body pos="0 0 0.034"><geom size="0.0002"/></body>)"), plain);
  EXPECT_EQ(shapes(R"(<body pos="0.02 0 0.01"><geom size="0.002"/></body>)"), plain + 1);
}

/// The planner knows all geometry of a fingertip's body, which other links must not touch.
TEST_F(CheckModelTest, GeometryThatAFingertipReplacesIsCovered) {
  const auto covered = [&](const std::string& inside) {
    const HandModel hand = InspectHand(Write("ring.xml", RingXml({.inside = inside}))).hand;
    return std::ranges::count(hand.fingers[0].shapes, LinkShape::Role::kCovered, &LinkShape::role);
  };
  // Capsule and sphere.
  EXPECT_EQ(covered(""), 2);
  EXPECT_EQ(covered(R"(<geom size="0.002" pos="0 0 0.026"/>)"), 3);
  EXPECT_EQ(covered(R"(<geom size="0.002" pos="0 0 0.026" contype="0" conaffinity="0"/>)"), 2);
}

}  // namespace check_model_test
}  // namespace regrasp::kinematics
