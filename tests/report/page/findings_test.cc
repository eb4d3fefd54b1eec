#include "report/page/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "sim/measure/disturbance.h"

namespace regrasp::report {
namespace findings_test {

using testing::HasSubstr;
using testing::Not;

Report MakeReport() {
  Report report;
  report.friction_angle = Radians(20);
  report.settings.emplace();
  report.settings->disturbance_ratio = 0.01;
  for (int index : {0, 1}) {
    ReportStep& step = report.steps.emplace_back();
    step.check.index = plan::EntryIndex(index);
    step.weakest_finger = {FingerIndex(3), {Radians(12), true, std::nullopt}};
    step.replay.emplace();
    step.replay->adapted = sim::StepMotion();
    step.replay->static_margins = {{FingerIndex(2), Radians(4.5)}};
    step.replay->disturbance_margins = {{FingerIndex(0), Radians(1.25)}};
  }
  return report;
}

std::string FormatFindings(const Report& report) {
  return Element("main", {}, MakeFindings(report)).Format();
}

TEST(FindingsTest, EveryReplayedStepHasItsWeakestFingerAndItsMargins) {
  const std::string text = FormatFindings(MakeReport());
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">3</td><td class=\"number\">12.00°</td>"));
  EXPECT_THAT(text, HasSubstr("4.50° (finger 2)"));
  EXPECT_THAT(text, HasSubstr("1.25° (finger 0)"));
  EXPECT_THAT(text, Not(HasSubstr("Disagreements")));
  EXPECT_THAT(text, Not(HasSubstr("Largest disturbance")));
  EXPECT_THAT(text, Not(HasSubstr("Fixed grasp force")));
}

TEST(FindingsTest, WhatWasNotReplayedHasNone) {
  Report report = MakeReport();
  report.steps[0].replay.reset();
  report.steps[1].skipped = true;
  EXPECT_TRUE(MakeFindings(report).empty());
}

TEST(FindingsTest, ADisagreementIsToldInWordsAndEscaped) {
  Report report = MakeReport();
  report.steps[1].replay->fixed = sim::StepMotion();
  report.steps[1].replay->fixed->reason = plan::Reason::kSlipped;
  report.steps[1].disagreement = sim::Disagreement{
      sim::Between::kFixedFails, sim::Cause::kConeReached, "finger <2> & its cone", {}};
  const std::string text = FormatFindings(report);
  EXPECT_THAT(
      text,
      HasSubstr("Step 1: adapted forces resist the disturbance, a fixed grasp force does not. "
                "Likely cause: finger &lt;2&gt; &amp; its cone."));
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">fail: slipped</td>"));
}

TEST(FindingsTest, ThePushesAreATableOfBothRoutesAndAPlotOfTheLeast) {
  Report report = MakeReport();
  for (ReportStep& step : report.steps) {
    for (const sim::Disturbance& disturbance : sim::DisturbanceDirections(3)) {
      step.replay->resisted_wrench.push_back({disturbance, 0.25, 0.27});
    }
  }
  const std::string text = FormatFindings(report);
  EXPECT_THAT(text, HasSubstr("25 | 27"));
  EXPECT_THAT(text, HasSubstr("torque -z"));
  EXPECT_THAT(text, HasSubstr("<svg"));
  report.steps.resize(1);
  EXPECT_THAT(FormatFindings(report), Not(HasSubstr("<svg"))) << "one entry is no plot";
}

}  // namespace findings_test
}  // namespace regrasp::report
