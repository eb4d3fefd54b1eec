#include "planner/grasp/quality_rays.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace quality_filter_test {

struct Counts {
  int good = 0;
  int poor = 0;
  int missed = 0;
};

/// Query one filter about many grasps, each at two thresholds around its quality and at a common
/// threshold.
Counts Ask(int dimension, double friction_angle, QualityFilter& filter) {
  constexpr double kSame = 0.05;
  RandomGrasps random(17);
  const object::WrenchFrame frame = UnitFrame(dimension);
  Counts counts;
  for (int trial = 0; trial < 80; ++trial) {
    const Grasp grasp = random.OnBall(dimension + 1, dimension);
    if (!IsForceClosure(grasp, frame, friction_angle)) continue;
    const QualityBounds bounds = ComputeQuality(grasp, frame, friction_angle);
    for (const double threshold : {0.5 * bounds.lower, 1.5 * bounds.upper, kSame}) {
      const bool good = filter.IsClearlyAtLeast(grasp, threshold);
      EXPECT_FALSE(good && threshold > bounds.upper) << trial << " at " << threshold;
      ++(good ? counts.good : counts.poor);
      counts.missed += !good && threshold <= 0.9 * bounds.lower ? 1 : 0;
    }
  }
  return counts;
}

TEST(QualityFilterTest, SaysYesOnlyWhereTheQualityIsThereAndSeldomNoWhereItIs) {
  for (const int dimension : {2, 3}) {
    QualityFilter filter(UnitFrame(dimension), Radians(25));
    const Counts counts = Ask(dimension, Radians(25), filter);
    EXPECT_GT(counts.good, 15);
    EXPECT_GT(counts.poor, 15);
    EXPECT_LE(counts.missed, counts.good / 20);
  }
}

TEST(QualityFilterTest, TwistsThatRefutedSomeRefuteMostOthers) {
  RandomGrasps random(23);
  const object::WrenchFrame frame = UnitFrame(3);
  QualityFilter filter(frame, Radians(20));
  int asked = 0;
  for (int trial = 0; trial < 800; ++trial) {
    const Grasp grasp = random.OnBall(4, 3);
    if (!IsForceClosure(grasp, frame, Radians(20))) continue;
    EXPECT_FALSE(filter.IsClearlyAtLeast(grasp, 0.6));
    ++asked;
  }
  EXPECT_GT(asked, 100);
  EXPECT_GT(filter.shot_count(), 0);
  EXPECT_LT(filter.shot_count(), asked / 2);
}

}  // namespace quality_filter_test
}  // namespace regrasp::grasp
