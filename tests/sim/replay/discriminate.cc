#include "tests/sim/replay/discriminate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {

namespace {

constexpr double kBelow = 0.9;  ///< share of the required μ: must fail
/// multiple of the required μ: must pass if the quality is sufficient
constexpr double kAbove = 1.5;

/// Return the required friction coefficient of a grasp; nullopt if its angle is outside (0.1°,
/// 50°).
std::optional<double> RequiredMu(const object::Object& body, const plan::FingerGrasp& grasp) {
  const auto required =
      grasp::ComputeRequiredFrictionAngle(plan::ContactsOf(grasp), body.wrench_frame());
  if (!required || required->upper > Radians(50) || required->upper < Radians(0.1)) return {};
  return std::tan(required->upper);
}

StepReplay ReplayHold(const object::Object& body, const plan::FingerGrasp& grasp, double mu) {
  plan::Plan plan = MakePlan(grasp, Degrees(std::atan(mu)), 4);
  plan.dimension = body.dimension();
  return ReplayPlan(body, plan, {}).steps.at(0);
}

DiscriminationCount DiscriminateGrasp(const object::Object& body, const plan::FingerGrasp& grasp,
                                      double mu) {
  DiscriminationCount count;
  count.below = 1;
  count.failed_below = ReplayHold(body, grasp, kBelow * mu).reason != plan::Reason::kNone;
  EXPECT_TRUE(count.failed_below) << "passes at 0.9 of its required friction";
  const double quality =
      grasp::ComputeQuality(plan::ContactsOf(grasp), body.wrench_frame(), std::atan(kAbove * mu))
          .lower;
  if (quality <= ReplayOptions().disturbance_ratio) return count;
  count.above = 1;
  const StepReplay above = ReplayHold(body, grasp, kAbove * mu);
  count.passed_above = above.reason == plan::Reason::kNone;
  EXPECT_TRUE(count.passed_above) << "fails at 1.5 of its required friction, quality " << quality
                                  << ": " << above.detail;
  return count;
}

}  // namespace

DiscriminationCount& DiscriminationCount::operator+=(const DiscriminationCount& other) {
  failed_below += other.failed_below;
  below += other.below;
  passed_above += other.passed_above;
  above += other.above;
  return *this;
}

DiscriminationCount Discriminate(
    const object::Object& body, const std::string& name, int grasps, unsigned seed,
    const std::function<plan::FingerGrasp(int index, std::mt19937& random)>& draw) {
  std::mt19937 random(seed);
  DiscriminationCount count;
  for (int i = 0; i < grasps; ++i) {
    plan::FingerGrasp grasp;
    std::optional<double> mu;
    while (!mu) {
      grasp = draw(i, random);
      mu = RequiredMu(body, grasp);
    }
    SCOPED_TRACE(name + ", grasp " + std::to_string(i) + ", critical mu " + std::to_string(*mu));
    count += DiscriminateGrasp(body, grasp, *mu);
  }
  return count;
}

void ExpectManyDiscriminated(const DiscriminationCount& count, const std::string& grasps) {
  std::cout << count.failed_below << " of " << count.below << " " << grasps
            << " fail at 0.9 of their required friction, " << count.passed_above << " of "
            << count.above << " pass at 1.5 of it\n";
  ::testing::Test::RecordProperty("below_checked", count.below);
  ::testing::Test::RecordProperty("below_failed", count.failed_below);
  ::testing::Test::RecordProperty("above_checked", count.above);
  ::testing::Test::RecordProperty("above_passed", count.passed_above);
  EXPECT_GE(count.below, 100);
  EXPECT_GE(count.above, 100);
}

}  // namespace regrasp::sim
