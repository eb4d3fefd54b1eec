#include "report/failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "planner/base/number.h"
#include "report/report_table.h"

namespace regrasp::report {
namespace failure_test {

using plan::Reason;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Return a report whose step 0 passes and whose step 1 fails for a reason, with a required
/// friction angle.
Report FailingFor(Reason reason, double required_deg) {
  Report report;
  report.friction_angle = Radians(6);
  report.steps.resize(2);
  report.steps[0].check.kind = "hold";
  report.steps[1].check.kind = "align";
  report.steps[1].check.index = plan::EntryIndex(1);
  report.steps[1].check.reason = reason;
  report.steps[1].check.detail = "so far off";
  report.steps[1].check.required =
      grasp::RequiredFrictionAngle{Radians(required_deg), Radians(required_deg)};
  return report;
}

TEST(Failure, IsTheFirstStepThatFailsAndAPlanThatPassesHasNone) {
  Report report = FailingFor(Reason::kOffSurface, 0);
  const auto failure = DescribeFailure(report);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->entry, 1);
  EXPECT_EQ(failure->headline(), "step 1 (align) fails: off-surface: so far off");
  EXPECT_EQ(FormatFailure(report), failure->headline() + "\n  why: " + failure->why +
                                       "\n  help: " + failure->suggested_fix +
                                       "\n  more: regrasp validate --explain off-surface\n");
  report.steps[1].check.reason = Reason::kNone;
  EXPECT_FALSE(DescribeFailure(report));
  EXPECT_EQ(FormatFailure(report), "");
}

TEST(Failure, OfAPlanWhoseStepsPassAreTheTrialsThatFail) {
  Report report = FailingFor(Reason::kNone, 3);
  for (ReportStep& step : report.steps) step.replay.emplace();
  EXPECT_TRUE(report.passed());
  report.trials.emplace();
  sim::TrialSummary& trials = *report.trials;
  trials.options.count = 20;
  trials.passed = 20;
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(VerdictHeadline(report), "");
  trials.passed = 14;
  trials.reasons = {{Reason::kSlipped, 6}};
  trials.steps = {{plan::EntryIndex(1), 6}};
  EXPECT_FALSE(report.passed());
  EXPECT_TRUE(report.steps_passed());
  const auto failure = DescribeFailure(report);
  ASSERT_TRUE(failure);
  EXPECT_FALSE(failure->entry.valid());
  EXPECT_EQ(failure->headline(),
            "trials-failed: 6 of 20 trials with noise fail: 6 slipped; first in step 1: 6");
  EXPECT_EQ(failure->why, "14 of 20 trials pass (70 %), --trials min-pass-rate requires 100 %");
  EXPECT_THAT(failure->suggested_fix, Not(HasSubstr("min-pass-rate"))) << "loosens the test";
  EXPECT_EQ(VerdictHeadline(report), failure->headline());
  EXPECT_EQ(HeadingText(report),
            "FAIL: 6 of 20 trials with noise fail: 6 slipped; first in step 1: 6");
  trials.options.min_pass_rate = 0.7;
  EXPECT_TRUE(report.passed());
  EXPECT_FALSE(DescribeFailure(report));
  EXPECT_EQ(VerdictHeadline(report), "pass in 14 of 20 trials");
  EXPECT_EQ(HeadingText(report), "PASS in 14 of 20 trials: the hold and the step pass");
  report.trials.reset();
  EXPECT_EQ(HeadingText(report), "PASS: the hold and the step pass");
}

TEST(Failure, NamesTheRequiredFrictionOnceAndInTheSameDigits) {
  for (const double required : {5.3201, 5.3249, 5.3299, 6.0004, 6.004}) {
    const Report report = FailingFor(Reason::kNotForceClosure, required);
    const std::string number = FormatRequiredDegrees(required, 6).value;
    EXPECT_THAT(DescribeFailure(report)->suggested_fix,
                HasSubstr("--friction-angle " + number + " "));
    if (required > 6) {
      EXPECT_GT(std::stod(number), 6);
    }
  }
}

TEST(Failure, SaysForEveryReasonWhatItIsHeldAgainstAndWhatWouldMendIt) {
  std::set<std::string> said;
  for (Reason reason = Reason::kOffSurface; reason <= Reason::kGoalNotReached;
       reason = static_cast<Reason>(static_cast<int>(reason) + 1)) {
    const Failure failure = *DescribeFailure(FailingFor(reason, 7));
    EXPECT_EQ(failure.reason, plan::ReasonName(reason));
    EXPECT_NE(failure.why, "") << failure.reason;
    EXPECT_NE(failure.suggested_fix, "") << failure.reason;
    said.insert(failure.reason);
  }
  EXPECT_EQ(said.size(), 26u);
}

TEST(Failure, AsksForTheFrictionThatIsNeededRoundedUp) {
  EXPECT_THAT(DescribeFailure(FailingFor(Reason::kNotForceClosure, 7.3312))->suggested_fix,
              HasSubstr("--friction-angle 7.34 or --mu 0.129;"));
  EXPECT_THAT(DescribeFailure(FailingFor(Reason::kNotForceClosure, 45))->suggested_fix,
              HasSubstr("--friction-angle 45.00 or --mu 1;"));
  Report none = FailingFor(Reason::kNotForceClosure, 45);
  none.steps[1].check.required.reset();
  EXPECT_THAT(DescribeFailure(none)->suggested_fix, Not(HasSubstr("--mu")));
}

TEST(Failure, OfAReplayGoesByTheLikelyCause) {
  Report report = FailingFor(Reason::kNone, 5);
  report.steps[1].replay.emplace().reason = Reason::kSlipped;
  report.steps[1].replay->detail = "finger 2 slipped";
  const std::string unknown = DescribeFailure(report)->suggested_fix;
  report.steps[1].disagreement =
      sim::Disagreement{sim::Between::kReplayFails, sim::Cause::kWeight, "too heavy"};
  const auto failure = DescribeFailure(report);
  EXPECT_EQ(failure->what, "finger 2 slipped");
  EXPECT_THAT(failure->why, EndsWith("; likely cause: too heavy"));
  EXPECT_THAT(failure->suggested_fix, HasSubstr("--grasp-force"));
  EXPECT_NE(failure->suggested_fix, unknown);
}

TEST(Failure, OfASlipTellsTheToleranceAsALength) {
  Report report = FailingFor(Reason::kNone, 5);
  report.steps[1].replay.emplace().reason = Reason::kSlipped;
  report.settings.emplace();
  report.settings->diameter_m = 0.104;
  report.settings->tolerance = 0.001;
  EXPECT_THAT(DescribeFailure(report)->why, StartsWith("limit: 104 µm, --tolerance 0.001 of"));
}

TEST(Failure, DoesNotSuggestALooserTest) {
  Report report = FailingFor(Reason::kNone, 5);
  report.steps[1].replay.emplace().reason = Reason::kObjectMoved;
  report.settings.emplace();
  report.settings->mass_kg = report.settings->grasp_force_N = 1;
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, HasSubstr("more friction"));
  report.settings->disturbance_ratio = 0.01;
  for (const char* looser : {"smaller --disturbance", "larger --tolerance"}) {
    EXPECT_THAT(DescribeFailure(report)->suggested_fix, Not(HasSubstr(looser)));
  }
}

TEST(Failure, OfAWrongNormalTellsTheTrueOne) {
  Report report = FailingFor(Reason::kWrongNormal, 5);
  report.steps[1].check.fault.expected = {{{1, 2, 0}, {0.6, -0.8, 0}}};
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, EndsWith(": (0.6, -0.8, 0)"));
  report.dimension = 2;
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, EndsWith(": (0.6, -0.8)"));
}

TEST(Failure, OfAContactThatNoFingerReachesSaysNothingOfThicknessWhereFingersArePoints) {
  Report report = FailingFor(Reason::kUnreachable, 5);
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, Not(HasSubstr("--finger-radius")));
  report.steps[1].check.fault.finger_radius = 0.01;
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, HasSubstr("--finger-radius"));
}

TEST(Failure, OfAHandThatCollidesTellsTheClearanceThatThereIsIfThereIsOne) {
  Report report = FailingFor(Reason::kHandCollides, 5);
  plan::HandFaultPlace& place = report.steps[1].check.fault.hand.emplace();
  place.gap_m = 3e-4;
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, HasSubstr("--clearance below 300 µm"));
  place.gap_m = -3e-3;
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, HasSubstr("links penetrate each other"));
}

TEST(Failure, OfAHandIsHeldAgainstTheLimitsOfTheCheckOrOfTheReplay) {
  struct Case {
    Reason reason;
    std::string check, replay;  ///< part of the rule of each
  };
  for (const Case& expected :
       {Case{Reason::kCouplingViolated, "to 1 µrad", "within 1.00° of their coupling"},
        Case{Reason::kHandCollides, "keep the clearance", "must not touch"},
        Case{Reason::kJointLimit, "within the limits of the hand's model", "model, to 1.00°"}}) {
    Report checked = FailingFor(expected.reason, 5);
    checked.steps[1].check.fault.hand.emplace();
    Report replayed = FailingFor(Reason::kNone, 5);
    sim::StepReplay& replay = replayed.steps[1].replay.emplace();
    replay.reason = expected.reason;
    replay.fault.hand.emplace();
    EXPECT_THAT(DescribeFailure(checked)->why, HasSubstr(expected.check));
    EXPECT_THAT(DescribeFailure(checked)->why, Not(HasSubstr(expected.replay)));
    EXPECT_THAT(DescribeFailure(replayed)->why, HasSubstr(expected.replay));
  }
}

TEST(Failure, OfACouplingInTheReplayIsMendedInTheModel) {
  Report report = FailingFor(Reason::kNone, 5);
  sim::StepReplay& replay = report.steps[1].replay.emplace();
  replay.reason = Reason::kCouplingViolated;
  replay.fault.hand.emplace();
  EXPECT_THAT(DescribeFailure(report)->suggested_fix, HasSubstr("use a model"));
}

TEST(Failure, OfATorqueLimitStatesTheTimeThatTheReplayTolerates) {
  Report report = FailingFor(Reason::kNone, 5);
  report.steps[1].replay.emplace().reason = Reason::kTorqueLimit;
  report.settings.emplace().hand.emplace().tolerance.limit_s = 0.02;
  EXPECT_THAT(DescribeFailure(report)->why, EndsWith("longer than 20 ms"));
}

TEST(Failure, OfAGoalThatIsNotReachedKnowsContactsFromPoses) {
  Report report = FailingFor(Reason::kGoalNotReached, 5);
  EXPECT_THAT(DescribeFailure(report)->why, HasSubstr("contacts"));
  report.steps[1].check.fault.hand.emplace();
  EXPECT_THAT(DescribeFailure(report)->why, Not(HasSubstr("contacts")));
}

}  // namespace failure_test
}  // namespace regrasp::report
