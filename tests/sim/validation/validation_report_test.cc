#include "sim/validation/validation_report.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"

namespace regrasp::validation {
namespace validation_report_test {

ReportStep StepThatNeeds(int index, double required_deg) {
  ReportStep step;
  step.check.index = plan::EntryIndex(index);
  step.check.required = grasp::RequiredFrictionAngle{Radians(required_deg), Radians(required_deg)};
  step.replay.emplace().index = step.check.index;
  return step;
}

Report PassingReport() {
  Report report;
  report.steps = {StepThatNeeds(0, 12), StepThatNeeds(1, 17.5), StepThatNeeds(2, 15)};
  return report;
}

TEST(ValidationReport, PassesOnlyIfEveryStepPasses) {
  EXPECT_TRUE(PassingReport().passed());
  Report replayed = PassingReport();
  replayed.steps[1].replay->reason = plan::Reason::kSlipped;
  EXPECT_FALSE(replayed.passed());
  Report analytic = PassingReport();
  analytic.steps[0].check.reason = plan::Reason::kOffSurface;
  EXPECT_FALSE(analytic.passed());
}

TEST(ValidationReport, TheReasonOfTheCheckComesBeforeThatOfTheReplay) {
  ReportStep step = StepThatNeeds(0, 12);
  EXPECT_EQ(step.reason(), plan::Reason::kNone);
  step.replay->reason = plan::Reason::kContactLost;
  EXPECT_EQ(step.reason(), plan::Reason::kContactLost);
  step.check.reason = plan::Reason::kWrongNormal;
  EXPECT_EQ(step.reason(), plan::Reason::kWrongNormal);
  step.skipped = true;
  EXPECT_EQ(step.reason(), plan::Reason::kNone);
  EXPECT_EQ(step.verdict(), Verdict::kSkipped);
}

TEST(ValidationReport, TheWeakestStepHasTheLargestRequiredFrictionAngle) {
  Report report = PassingReport();
  EXPECT_EQ(report.weakest_step(), 1);
  report.steps[1].check.required.reset();
  EXPECT_EQ(report.weakest_step(), 2);
  for (ReportStep& step : report.steps) step.check.required.reset();
  EXPECT_FALSE(report.weakest_step().valid());
}

}  // namespace validation_report_test
}  // namespace regrasp::validation
