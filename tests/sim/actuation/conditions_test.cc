#include "sim/actuation/conditions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "sim/actuation/condition_replays.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace conditions_test {

using testing::HasSubstr;

HandReplayOptions Under(const std::string& members, const HandReplayOptions& nominal = {}) {
  return OptionsUnder(ReadConditions("[{\"name\": \"one\", " + members + "}]", "c.json").front(),
                      nominal);
}

TEST(ConditionsTest, MembersSetTheirOptions) {
  EXPECT_EQ(Under("\"friction_factor\": 0.9").friction_factor, 0.9);
  EXPECT_EQ(Under("\"mass_factor\": 1.25").mass_factor, 1.25);
  EXPECT_EQ(Under("\"feedback\": \"none\"").sensing.feedback, PoseFeedback::kNone);
  EXPECT_EQ(Under("\"pose_delay_s\": 0.03").sensing.pose_delay_s, 0.03);
  EXPECT_EQ(Under("\"pose_rate_Hz\": 100").sensing.pose_rate_Hz, 100);
  EXPECT_NEAR(Under("\"pose_noise_mm\": 2").sensing.pose_noise_m, 2e-3, 1e-15);
  EXPECT_NEAR(Under("\"pose_bias_deg\": 2").sensing.pose_bias_rad, Radians(2), 1e-15);
  EXPECT_NEAR(Under("\"joint_bias_deg\": 1").sensing.joint_bias_rad, Radians(1), 1e-15);
  EXPECT_EQ(Under("\"touch_N\": 0.3").sensing.touch_N, 0.3);
  EXPECT_EQ(Under("\"command_delay_s\": 0.02").sensing.command_delay_s, 0.02);
  EXPECT_EQ(Under("\"timestep_s\": 0.002").physics.timestep_s, 0.002);
  EXPECT_TRUE(Under("\"cones\": \"pyramidal\"").physics.pyramidal_cones);
  EXPECT_EQ(Under("\"contacts\": \"default\"").physics.contacts, TipContactModel::kDefault);
  EXPECT_NEAR(Under("\"torsion_mm\": 5").physics.torsion_m, 5e-3, 1e-15);
  EXPECT_EQ(Under("\"gain_factor\": 0.8").physics.gain_factor, 0.8);
  EXPECT_EQ(Under("\"joint_friction_Nm\": 0.03").physics.joint_friction_Nm, 0.03);
  EXPECT_NEAR(Under("\"start_shift_mm\": [0, 3, 4]").start_shift_m.norm(), 5e-3, 1e-15);
  EXPECT_NEAR(Under("\"start_turn_deg\": [2, 0, 0]").start_turn_rad.x(), Radians(2), 1e-15);
  EXPECT_EQ(Under("\"fingertip\": \"geometry\"").tip, TipShape::kGeometry);
}

TEST(ConditionsTest, OtherOptionsAreTheNominalOnes) {
  HandReplayOptions nominal;
  nominal.friction_factor = 0.5;
  nominal.sensing.pose_delay_s = 0.2;
  nominal.tolerance.length_m = 7e-3;
  const HandReplayOptions options = Under("\"friction_factor\": 0.9", nominal);
  EXPECT_EQ(options.friction_factor, 0.45);
  EXPECT_EQ(options.sensing, nominal.sensing);
  EXPECT_EQ(options.physics, nominal.physics);
  EXPECT_EQ(options.tolerance.length_m, 7e-3);
  EXPECT_EQ(options.disturbance_ratio, 0);
  EXPECT_EQ(options.freeze_s, 0);
  EXPECT_TRUE(options.to_end);
}

/// Return the message with which a text is refused; empty if it is read.
std::string Refusal(const std::string& text) {
  try {
    static_cast<void>(ReadConditions(text, "c.json"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ConditionsTest, InvalidFilesAreRefusedWithThePlaceOfTheFault) {
  EXPECT_EQ(Refusal(R"([{"name": "a", "gain_factor": 0.5}])"), "");
  EXPECT_EQ(Refusal("[]"), "c.json: expected at least one condition, found an empty array");
  EXPECT_EQ(Refusal(R"({"name": "a"})"), "c.json: expected a JSON array, found a JSON object");
  EXPECT_EQ(Refusal(R"([{"gain_factor": 1}])"), "c.json: /0: member \"name\" not found");
  EXPECT_EQ(Refusal(R"([{"name": "a"}, {"name": "a"}])"),
            "c.json: /1/name: must be unique, found twice: \"a\"");
  EXPECT_EQ(Refusal(R"([{"name": "a", "gains": 1}])"),
            "c.json: /0: member \"gains\" not supported");
  EXPECT_EQ(Refusal(R"([{"name": "a", "gain_factor": 0}])"),
            "c.json: /0/gain_factor: expected a number from 0.01 to 100, found 0");
  EXPECT_EQ(Refusal(R"([{"name": "a", "gain_factor": "1"}])"),
            "c.json: /0/gain_factor: expected a number, found \"1\"");
  EXPECT_EQ(Refusal(R"([{"name": "a", "cones": "round"}])"),
            "c.json: /0/cones: expected \"elliptic\" or \"pyramidal\", found \"round\"");
  EXPECT_THAT(Refusal(R"([{"name": "a", "start_shift_mm": [1, 2]}])"),
              HasSubstr("/0/start_shift_mm: expected 3 numbers, found 2"));
  EXPECT_THAT(Refusal(R"([{"name": "a", "start_shift_mm": [1, 2, 1e9]}])"),
              HasSubstr("/0/start_shift_mm/2: expected a number from -1000 to 1000"));
}

TEST(ConditionsTest, TheNumberOfConditionsIsLimited) {
  const auto of_size = [](int size) {
    std::string text;
    for (int i = 0; i < size; ++i) {
      text += (i == 0 ? "[" : ",") + (R"({"name": ")" + std::to_string(i) + R"("})");
    }
    return text + "]";
  };
  EXPECT_EQ(Refusal(of_size(1000)), "");
  EXPECT_EQ(Refusal(of_size(1001)), "c.json: expected at most 1000 conditions, found 1001");
}

TEST(ConditionsTest, EveryStandardConditionChangesTheReplayAndHasAName) {
  std::set<std::string> names;
  for (const HandCondition& condition : StandardConditions()) {
    EXPECT_TRUE(names.insert(condition.name).second) << condition.name;
    EXPECT_NE(condition.changes, "{}") << condition.name;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"blind", "camera", "realistic", "pose-exact",
                                            "pyramidal-cones", "default-contacts"}));
}

/// A plan for ring5 that all replays share.
class ConditionReplaysTest : public HeldInHand {
 protected:
  [[nodiscard]] ConditionSummary Run(const std::string& conditions, int jobs = 1) const {
    HandReplayOptions nominal;
    nominal.mass_kg = kMass;
    return RunConditions(hand_, solid(), plan_, nominal, ReadConditions(conditions, "c.json"),
                         jobs);
  }
};

TEST_F(ConditionReplaysTest, ResultsDoNotDependOnTheNumberOfThreads) {
  const std::string text =
      R"([{"name": "light", "mass_factor": 0.8}, {"name": "icy", "friction_factor": 0.1},
          {"name": "weak", "gain_factor": 0.8}])";
  const ConditionSummary one = Run(text, 1);
  const ConditionSummary three = Run(text, 3);
  ASSERT_EQ(one.results.size(), 3U);
  for (std::size_t i = 0; i < one.results.size(); ++i) {
    EXPECT_EQ(one.results[i].condition.name, three.results[i].condition.name);
    EXPECT_EQ(one.results[i].reason, three.results[i].reason);
    EXPECT_EQ(one.results[i].end_m, three.results[i].end_m);
    EXPECT_EQ(one.results[i].margin, three.results[i].margin);
  }
}

TEST_F(ConditionReplaysTest, AConditionWithoutChangesIsTheNominalReplay) {
  HandReplayOptions nominal;
  nominal.mass_kg = kMass;
  const ReplayResult replay = ReplayHand(hand_, solid(), plan_, nominal);
  const ConditionResult result = Run(R"([{"name": "same"}])").results.front();
  EXPECT_TRUE(result.passed()) << result.detail;
  EXPECT_TRUE(result.reaches_end);
  EXPECT_TRUE(result.ends_within);
  EXPECT_GT(result.margin, 0);
  EXPECT_LT(result.margin, 1);
  EXPECT_EQ(result.end_m, replay.steps.back().hand->rest_off_m);
}

/// A replay under a condition continues after a violation, so that its end is known.
TEST_F(ConditionReplaysTest, AReplayContinuesAfterAViolation) {
  HandReplayOptions nominal;
  nominal.mass_kg = kMass;
  nominal.tolerance.depth_m = 1e-6;
  const ConditionSummary summary = RunConditions(
      hand_, solid(), plan_, nominal, ReadConditions(R"([{"name": "same"}])", "c.json"), 1);
  const ConditionResult& result = summary.results.front();
  EXPECT_EQ(result.reason, plan::Reason::kTipPenetrates) << result.detail;
  EXPECT_EQ(result.failed, plan::EntryIndex(0));
  EXPECT_TRUE(result.reaches_end);
  EXPECT_TRUE(result.ends_within);
  EXPECT_EQ(summary.passed(), 0);
  EXPECT_EQ(summary.ended_within(), 1);
}

/// A requirement cannot be met by conditions that do not apply.
TEST_F(ConditionReplaysTest, WithoutAnApplicableConditionARequirementFails) {
  HandReplayOptions nominal;
  nominal.mass_kg = kMass;
  nominal.engine = EngineChoice::kOde;
  const auto conditions = ReadConditions(R"([{"name": "cones", "cones": "pyramidal"}])", "c.json");
  ConditionSummary summary = RunConditions(hand_, solid(), plan_, nominal, conditions, 1);
  EXPECT_EQ(summary.applicable(), 0);
  EXPECT_TRUE(summary.enough());
  summary.required = 1;
  EXPECT_FALSE(summary.enough());
}

TEST_F(ConditionReplaysTest, TheRequiredShareDecides) {
  ConditionSummary summary = Run(R"([{"name": "same"}, {"name": "icy", "friction_factor": 0.1}])");
  EXPECT_EQ(summary.applicable(), 2);
  EXPECT_EQ(summary.passed(), 1);
  EXPECT_FALSE(summary.results[1].ends_within);
  EXPECT_TRUE(summary.enough());
  summary.required = 0.5;
  EXPECT_TRUE(summary.enough());
  summary.required = 0.51;
  EXPECT_FALSE(summary.enough());
}

}  // namespace conditions_test
}  // namespace regrasp::sim
