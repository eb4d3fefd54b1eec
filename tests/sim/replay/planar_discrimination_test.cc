#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "tests/sim/planar_cases.h"

namespace regrasp {
namespace {

constexpr int kGraspsPerPolygon = 100;
constexpr unsigned kSeed = 20240608;
constexpr double kBelow = 0.9;  ///< of the critical μ: must fail
constexpr double kAbove = 1.5;  ///< of the critical μ: must pass where the quality allows

struct Count {
  int failed_below = 0, below = 0;
  int passed_above = 0, above = 0;
};

/// A random grasp of so many contacts that some friction below 50° makes force closure.
FingerGrasp DrawGrasp(const Polygon& polygon, int contacts, std::mt19937& random,
                      double& critical_mu) {
  for (;;) {
    FingerGrasp grasp;
    for (int f = 0; f < contacts; ++f) grasp.push_back(DrawOnBoundary(polygon, f, random));
    const auto required = ComputeRequiredHalfAngle(ContactsOf(grasp), polygon.wrench_frame());
    if (!required || required->upper > Radians(50) || required->upper < Radians(0.1)) continue;
    critical_mu = std::tan(required->upper);
    return grasp;
  }
}

StepReplay ReplayHold(const Polygon& polygon, const FingerGrasp& grasp, double mu) {
  return ReplayPlan(polygon, MakePlanarPlan(grasp, Degrees(std::atan(mu))), {}).steps.at(0);
}

Count Discriminate(const Polygon& polygon, const std::string& name) {
  std::mt19937 random(kSeed);
  Count count;
  for (int i = 0; i < kGraspsPerPolygon; ++i) {
    double mu = 0;
    const FingerGrasp grasp = DrawGrasp(polygon, 2 + i % 2, random, mu);
    SCOPED_TRACE(name + ", grasp " + std::to_string(i) + ", critical mu " + std::to_string(mu));
    ++count.below;
    const bool fails = ReplayHold(polygon, grasp, kBelow * mu).reason != Reason::kNone;
    EXPECT_TRUE(fails) << "passes at 0.9 of its critical friction";
    count.failed_below += fails;
    const double quality =
        ComputeQuality(ContactsOf(grasp), polygon.wrench_frame(), std::atan(kAbove * mu)).lower;
    if (quality <= ReplayOptions().shake) continue;
    ++count.above;
    const StepReplay above = ReplayHold(polygon, grasp, kAbove * mu);
    const bool passes = above.reason == Reason::kNone;
    EXPECT_TRUE(passes) << "fails at 1.5 of its critical friction, quality " << quality << ": "
                        << above.detail;
    count.passed_above += passes;
  }
  return count;
}

TEST(PlanarDiscrimination, GraspsBelowTheirCriticalFrictionFailAndGoodOnesAbovePass) {
  const Polygon quadrilateral =
      Polygon::FromWkt("POLYGON((0 0, .09 .01, .07 .06, .01 .05, 0 0))", "quadrilateral");
  const Count convex = Discriminate(quadrilateral, "quadrilateral");
  const Count concave = Discriminate(MakeL(), "L");
  const int below = convex.below + concave.below, above = convex.above + concave.above;
  const int failed = convex.failed_below + concave.failed_below;
  const int passed = convex.passed_above + concave.passed_above;
  std::cout << failed << " of " << below
            << " planar grasps fail at 0.9 of their critical friction, " << passed << " of "
            << above << " pass at 1.5 of it\n";
  RecordProperty("below_checked", below);
  RecordProperty("below_failed", failed);
  RecordProperty("above_checked", above);
  RecordProperty("above_passed", passed);
  EXPECT_GE(below, 100);
  EXPECT_GE(above, 100);
}

}  // namespace
}  // namespace regrasp
