#include <gtest/gtest.h>

#include <cmath>

#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/projection.h"
#include "sim/actuation/hand_replay.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace hand_trials_test {

class HandTrialsTest : public testing::Test {
 protected:
  HandTrialsTest() {
    request_.hand = &hand_.hand;
    request_.solid = &solid();
    request_.scale = 0.8333;
    request_.criteria.friction_angle = std::atan(0.5);
    request_.criteria.min_quality = 0.06;
    request_.turn = {Eigen::Vector3d::UnitZ(), 0.3};
    const gait::GaitResult found = gait::FindGait(request_);
    if (!found.gait) throw std::runtime_error(found.message);
    plan_ = plan::ProjectPlan(solid(), gait::PlanOf(*found.gait, request_, found.contacts));
    plan_.friction_angle = std::atan(0.8);
    options_.mass_kg = 0.125;
  }
  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*cube_.object);
  }
  [[nodiscard]] TrialSummary Run(const TrialOptions& trials) const {
    return RunHandTrials(hand_, solid(), plan_, options_, trials);
  }

  const std::string models_ = ProjectPath("models/");
  kinematics::HandFile hand_ = kinematics::ReadHandFile(models_ + "hands/ring5.json");
  object::ObjectFile cube_ = object::ReadObject(models_ + "cube.obj");
  gait::GaitRequest request_;
  plan::Plan plan_;
  HandReplayOptions options_;
};

TEST_F(HandTrialsTest, WithoutNoiseEveryTrialIsTheNominalReplay) {
  EXPECT_EQ(ReplayHand(hand_, solid(), plan_, options_).steps.back().reason, plan::Reason::kNone);
  EXPECT_EQ(Run({.count = 2, .position_noise = 0, .friction_error = 0, .mass_error = 0}).passed, 2);
}

TEST_F(HandTrialsTest, ALittleNoiseIsBorneAndMuchIsNot) {
  const TrialSummary little = Run({.count = 4,
                                   .position_noise = 0.003,
                                   .friction_error = 0.02,
                                   .mass_error = 0.05,
                                   .joint_noise = 0.003});
  EXPECT_EQ(little.passed, 4);
  const TrialSummary much = Run({.count = 4, .position_noise = 0.2, .joint_noise = 0.2});
  EXPECT_EQ(much.passed, 0);
  int failed = 0;
  for (const auto& [reason, count] : much.reasons) failed += count;
  EXPECT_EQ(failed, 4);
}

TEST_F(HandTrialsTest, ATrialDependsOnTheSeedAndItsNumberAlone) {
  const TrialOptions trials{.count = 3, .seed = 7, .position_noise = 0.02, .joint_noise = 0.02};
  const TrialSummary a = Run(trials);
  const TrialSummary b = Run(trials);
  EXPECT_EQ(a.passed, b.passed);
  EXPECT_EQ(a.reasons, b.reasons);
  EXPECT_EQ(a.steps, b.steps);
}

}  // namespace hand_trials_test
}  // namespace regrasp::sim
