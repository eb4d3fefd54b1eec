#include "report/failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/angle.h"

namespace regrasp::report {
namespace {

using plan::Reason;
using testing::HasSubstr;
using testing::Not;

/// Step 0 passes, step 1 fails for a reason, and needs a half-angle.
Report FailingFor(Reason reason, double required_deg) {
  Report report;
  report.half_angle = Radians(6);
  report.steps.resize(2);
  report.steps[0].check.kind = "hold";
  report.steps[1].check.kind = "align";
  report.steps[1].check.index = plan::EntryIndex(1);
  report.steps[1].check.reason = reason;
  report.steps[1].check.detail = "so far off";
  report.steps[1].check.required =
      grasp::RequiredHalfAngle{Radians(required_deg), Radians(required_deg)};
  return report;
}

TEST(Failure, IsTheFirstStepThatFailsAndAPlanThatPassesHasNone) {
  Report report = FailingFor(Reason::kOffSurface, 0);
  const auto failure = DescribeFailure(report);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->step, 1);
  EXPECT_EQ(failure->what, "step 1 (align) fails: off-surface");
  EXPECT_EQ(failure->why, "so far off");
  report.steps[1].check.reason = Reason::kNone;
  EXPECT_FALSE(DescribeFailure(report));
  EXPECT_EQ(FormatFailure(report), "");
}

TEST(Failure, SaysForEveryReasonWhatWouldMendIt) {
  int count = 0;
  for (Reason reason = Reason::kOffSurface; reason <= Reason::kGoalNotReached;
       reason = static_cast<Reason>(static_cast<int>(reason) + 1)) {
    EXPECT_NE(DescribeFailure(FailingFor(reason, 7))->mend, "") << plan::ReasonName(reason);
    ++count;
  }
  EXPECT_EQ(count, 17);
}

TEST(Failure, AsksForTheFrictionThatIsNeededRoundedUp) {
  EXPECT_THAT(DescribeFailure(FailingFor(Reason::kNotForceClosure, 7.3312))->mend,
              HasSubstr("--friction-angle 7.34 or --mu 0.129;"));
  EXPECT_THAT(DescribeFailure(FailingFor(Reason::kNotForceClosure, 45))->mend,
              HasSubstr("--friction-angle 45 or --mu 1;"));
  Report none = FailingFor(Reason::kNotForceClosure, 45);
  none.steps[1].check.required.reset();
  EXPECT_THAT(DescribeFailure(none)->mend, Not(HasSubstr("--mu")));
}

TEST(Failure, OfAReplayGoesByTheLikelyCause) {
  Report report = FailingFor(Reason::kNone, 5);
  report.steps[1].replay.emplace().reason = Reason::kSlipped;
  report.steps[1].replay->detail = "finger 2 slipped";
  const std::string unknown = DescribeFailure(report)->mend;
  report.steps[1].disagreement =
      sim::Disagreement{sim::Between::kReplayFails, sim::Cause::kWeight, "too heavy"};
  const auto failure = DescribeFailure(report);
  EXPECT_EQ(failure->why, "finger 2 slipped; likely cause: too heavy");
  EXPECT_THAT(failure->mend, HasSubstr("--squeeze"));
  EXPECT_NE(failure->mend, unknown);
}

}  // namespace
}  // namespace regrasp::report
