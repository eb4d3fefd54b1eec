#include "tests/sim/replay/replay_expectations.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace regrasp::sim {

namespace {

std::vector<double> RecordReplay(const object::Object& object, const plan::Plan& plan) {
  std::vector<double> bits;
  ReplayObserver observer;
  observer.sample_interval_s = 1e-4;
  observer.on_sample = [&](const plan::Snapshot& sample) {
    bits.push_back(sample.time_s);
    for (int k = 0; k < 3; ++k) bits.push_back(sample.X_WO.translation()[k]);
    for (const plan::FingerState& state : sample.fingers) {
      for (int k = 0; k < 3; ++k) bits.insert(bits.end(), {state.tip_W[k], state.force_W[k]});
    }
  };
  const ReplayResult result = ReplayPlan(object, plan, {}, observer);
  for (const StepReplay& step : result.steps) {
    bits.insert(bits.end(), {step.displacement_m, step.rotation_deg, step.slip_m, step.drift_m});
  }
  return bits;
}

void ExpectTouches(const object::Object& object, const plan::FingerGrasp& grasp,
                   const plan::Snapshot& shown) {
  std::size_t touching = 0;
  for (const plan::FingerContact& held : grasp) {
    for (const plan::FingerState& state : shown.fingers) {
      if (state.finger != held.finger) continue;
      EXPECT_LT((shown.X_WO.inverse() * state.contact_W - held.contact.p).norm(),
                kGood * object.diameter());
      EXPECT_GT(state.force_W.dot(held.contact.n), 0) << "finger " << held.finger;
      ++touching;
    }
  }
  EXPECT_EQ(touching, grasp.size());
}

}  // namespace

void ExpectGood(const ReplayResult& result, std::size_t entries) {
  ASSERT_EQ(result.steps.size(), entries);
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, plan::Reason::kNone) << "entry " << step.index << ": " << step.detail;
    EXPECT_LT(step.displacement_m, kGood * result.settings.diameter_m);
    EXPECT_LT(step.slip_m, kGood * result.settings.diameter_m);
    EXPECT_LT(step.drift_m, kGood * result.settings.diameter_m);
    EXPECT_FALSE(step.contact_lost);
  }
}

bool LosesObject(plan::Reason reason) {
  return reason == plan::Reason::kContactLost || reason == plan::Reason::kSlipped ||
         reason == plan::Reason::kObjectMoved;
}

void ExpectTouchesAsPlanned(const object::Object& object, const plan::Plan& plan,
                            const ReplayResult& result) {
  ASSERT_EQ(result.steps.size(), plan.steps.size() + 1);
  plan::FingerGrasp grasp = plan.initial;
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    if (i > 0) grasp = plan::GraspAfter(grasp, plan.steps[i - 1]);
    SCOPED_TRACE("entry " + std::to_string(i));
    ExpectTouches(object, grasp, result.steps[i].snapshot);
  }
}

void ExpectSameBitsTwice(const object::Object& object, const plan::Plan& plan) {
  const std::vector<double> first = RecordReplay(object, plan);
  const std::vector<double> second = RecordReplay(object, plan);
  ASSERT_GT(first.size(), 1000u);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
}

}  // namespace regrasp::sim
