#include "planner/kinematics/hand_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/json.h"

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
  expect_fails("two fingers have the name a", [](Json& json) { json["fingers"][1]["name"] = "a"; });
  expect_fails("the same tip", [](Json& json) { json["fingers"][1]["tip"]["body"] = "tip_a"; });
  expect_fails("/fingers/0/tip/radius",
               [](Json& json) { json["fingers"][0]["tip"]["radius"] = 0; });
  expect_fails("/up: expected a direction", [](Json& json) { json["up"] = {0, 0, 0}; });
  expect_fails("/couplings/0/ratio", [](Json& json) { json["couplings"][0]["ratio"] = 0; });
  expect_fails("/couplings/1/offset", [](Json& json) { json["couplings"][1]["offset"] = "x"; });
  expect_fails("/palm", [](Json& json) { json["palm"] = ""; });
  expect_fails("format", [](Json& json) { json["format"] = "regrasp-plan"; });
}

}  // namespace hand_description_test
}  // namespace regrasp::kinematics
