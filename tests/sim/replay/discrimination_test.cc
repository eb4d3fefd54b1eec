#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "tests/sim/replay_cases.h"

namespace regrasp {
namespace {

constexpr int kGraspsPerObject = 75;
constexpr unsigned kSeed = 20240607;
constexpr double kBelow = 0.9;  ///< of the critical μ: must fail
constexpr double kAbove = 1.5;  ///< of the critical μ: must pass where the quality allows

struct Count {
  int failed_below = 0, below = 0;
  int passed_above = 0, above = 0;
};

/// A random grasp of four contacts that some friction below 50° makes force closure.
FingerGrasp DrawGrasp(const Polyhedron& body, std::mt19937& random, double& critical_mu) {
  for (;;) {
    FingerGrasp grasp;
    for (int f = 0; f < 4; ++f) grasp.push_back({f, DrawContact(body, random)});
    const auto required = ComputeRequiredHalfAngle(ContactsOf(grasp), body.wrench_frame());
    if (!required || required->upper > Radians(50) || required->upper < Radians(0.1)) continue;
    critical_mu = std::tan(required->upper);
    return grasp;
  }
}

Reason ReplayHold(const Polyhedron& body, const FingerGrasp& grasp, double mu,
                  std::string& detail) {
  Plan plan = MakePlan(grasp, Degrees(std::atan(mu)), 4);
  const StepReplay hold = ReplayPlan(body, plan, {}).steps.at(0);
  detail = hold.detail;
  return hold.reason;
}

Count Discriminate(const std::string& model) {
  const ObjectFile file = ReadModel(model);
  const auto& body = dynamic_cast<const Polyhedron&>(*file.object);
  std::mt19937 random(kSeed);
  Count count;
  for (int i = 0; i < kGraspsPerObject; ++i) {
    double mu = 0;
    const FingerGrasp grasp = DrawGrasp(body, random, mu);
    SCOPED_TRACE(model + ", grasp " + std::to_string(i) + ", critical mu " + std::to_string(mu));
    std::string detail;
    ++count.below;
    const bool fails = ReplayHold(body, grasp, kBelow * mu, detail) != Reason::kNone;
    EXPECT_TRUE(fails) << "passes at 0.9 of its critical friction";
    count.failed_below += fails;
    const double quality =
        ComputeQuality(ContactsOf(grasp), body.wrench_frame(), std::atan(kAbove * mu)).lower;
    if (quality <= ReplayOptions().shake) continue;
    ++count.above;
    const bool passes = ReplayHold(body, grasp, kAbove * mu, detail) == Reason::kNone;
    EXPECT_TRUE(passes) << "fails at 1.5 of its critical friction, quality " << quality << ": "
                        << detail;
    count.passed_above += passes;
  }
  return count;
}

TEST(Discrimination, GraspsBelowTheirCriticalFrictionFailAndGoodOnesAbovePass) {
  const Count cube = Discriminate("cube.obj"), l_block = Discriminate("l_block.obj");
  const int below = cube.below + l_block.below, above = cube.above + l_block.above;
  const int failed = cube.failed_below + l_block.failed_below;
  const int passed = cube.passed_above + l_block.passed_above;
  std::cout << failed << " of " << below << " grasps fail at 0.9 of their critical friction, "
            << passed << " of " << above << " pass at 1.5 of it\n";
  RecordProperty("below_checked", below);
  RecordProperty("below_failed", failed);
  RecordProperty("above_checked", above);
  RecordProperty("above_passed", passed);
  EXPECT_GE(below, 100);
  EXPECT_GE(above, 100);
}

}  // namespace
}  // namespace regrasp
