#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/actuation/condition_replays.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace condition_controls_test {

/// Return for each standard condition one with ten times its size, or the opposite, under which
/// ring5 cannot execute its plan.
const std::map<std::string, std::string>& Controls() {
  static const std::map<std::string, std::string> controls = {
      {"friction-minus-10", R"("friction_factor": 0.01)"},
      {"friction-minus-20", R"("friction_factor": 0.01)"},
      // More friction never makes a finger slip. The control is less friction.
      {"friction-plus-10", R"("friction_factor": 0.1)"},
      {"mass-minus-10", R"("mass_factor": 20)"},  // a light object is easy to hold
      {"mass-plus-10", R"("mass_factor": 20)"},
      {"mass-plus-25", R"("mass_factor": 20)"},
      {"gain-minus-20", R"("gain_factor": 0.02)"},
      {"gain-plus-20", R"("gain_factor": 12)"},
      {"latency-10ms", R"("command_delay_s": 1)"},
      {"latency-20ms", R"("command_delay_s": 2)"},
      {"pose-30ms", R"("pose_delay_s": 0.3, "pose_rate_Hz": 100, "pose_bias_mm": 100)"},
      {"camera", R"("pose_delay_s": 0.5, "pose_rate_Hz": 30, "pose_noise_mm": 30,
                    "pose_noise_deg": 30)"},
      {"realistic", R"("pose_delay_s": 0.5, "pose_rate_Hz": 3, "pose_noise_mm": 3,
                       "pose_noise_deg": 3, "pose_bias_mm": 6, "pose_bias_deg": 6,
                       "joint_bias_deg": 5, "command_delay_s": 0.1, "friction_factor": 0.1,
                       "mass_factor": 2, "touch_N": 3, "joint_friction_Nm": 0.1,
                       "gain_factor": 0.1)"},
      {"timestep-2ms", R"("timestep_s": 0.02)"},
      {"torsion-5mm", R"("torsion_mm": 50)"},
      {"start-off", R"("start_shift_mm": [5.77, 5.77, 5.77],
                       "start_turn_deg": [11.55, -11.55, 11.55])"},
      {"joints-0.5deg", R"("joint_bias_deg": 5)"},
      {"joints-1deg", R"("joint_bias_deg": 10)"},
      {"joint-friction", R"("joint_friction_Nm": 0.3)"},
  };
  return controls;
}

/// Conditions that have no size, or whose opposite is the nominal replay.
const std::set<std::string>& WithoutControl() {
  static const std::set<std::string> names = {
      "pose-exact",          // better than any camera
      "blind",               // there is nothing less than no pose
      "timestep-0.5ms",      // a smaller step is more accurate; the control is that of 2 ms
      "pyramidal-cones",     // HandPhysicsTest has a force at which pyramids slip and cones do not
      "default-contacts",    // HandPhysicsTest compares depth and constants
      "touch-0.3N",          // a finger that feels nothing presses 4 mm deeper and may still pass
      "fingertip-geometry",  // TipGeometryTest has geometry with which plans fail
  };
  return names;
}

class ConditionControlsTest : public HeldInHand, public testing::WithParamInterface<EngineChoice> {
 protected:
  [[nodiscard]] ConditionSummary Run(const std::vector<HandCondition>& conditions) const {
    HandReplayOptions nominal;
    nominal.mass_kg = kMass;
    nominal.engine = GetParam();
    return RunConditions(hand_, solid(), plan_, nominal, conditions, /*jobs=*/2);
  }
};

TEST_P(ConditionControlsTest, TenTimesTheSizeFails) {
  std::string text;
  for (const auto& [name, members] : Controls()) {
    text += (text.empty() ? "[" : ",") + ("{\"name\": \"" + name + "\", ") + members + "}";
  }
  for (const ConditionResult& result : Run(ReadConditions(text + "]", "controls")).results) {
    EXPECT_FALSE(result.passed()) << result.condition.name << ", margin " << result.margin;
  }
  // The plan passes without the changes.
  EXPECT_EQ(Run(ReadConditions(R"([{"name": "same"}])", "same")).passed(), 1);
}

INSTANTIATE_TEST_SUITE_P(Engines, ConditionControlsTest,
                         testing::Values(EngineChoice::kMujoco, EngineChoice::kOde),
                         [](const auto& tested) {
                           return tested.param == EngineChoice::kOde ? "Ode" : "Mujoco";
                         });

/// ODE omits the contact models of MuJoCo and no other condition.
class OdeConditionsTest : public HeldInHand {};

TEST_F(OdeConditionsTest, OnlyContactModelsOfMujocoAreSkipped) {
  HandReplayOptions nominal;
  nominal.mass_kg = kMass;
  nominal.engine = EngineChoice::kOde;
  std::set<std::string> skipped;
  int passed = 0;
  const ConditionSummary summary =
      RunConditions(hand_, solid(), plan_, nominal, StandardConditions(), /*jobs=*/2);
  for (const ConditionResult& result : summary.results) {
    if (!result.applies) {
      skipped.insert(result.condition.name);
      EXPECT_THAT(result.detail, testing::StartsWith("engine ode: "));
    }
    passed += result.passed() ? 1 : 0;
  }
  EXPECT_THAT(skipped,
              testing::UnorderedElementsAre("pyramidal-cones", "default-contacts", "torsion-5mm"));
  // Joint errors may exceed the tolerance margin of the plan, as in MuJoCo.
  EXPECT_GE(passed, summary.applicable() - 2);
}

TEST(ConditionControlsListTest, EveryStandardConditionHasAControlOrAReasonForNone) {
  for (const HandCondition& condition : StandardConditions()) {
    EXPECT_EQ(Controls().contains(condition.name) + WithoutControl().contains(condition.name), 1)
        << condition.name;
  }
}

}  // namespace condition_controls_test
}  // namespace regrasp::sim
