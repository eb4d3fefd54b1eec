#include "report/page/facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/base/number.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {
namespace facts_test {

using testing::HasSubstr;
using testing::Not;

std::string FormatFacts(const Report& report) {
  return MakeFacts(report, MeasureSteps(report)).Format() + MakeSettings(report).Format();
}

TEST(FactsTest, SettingsAreToldOnlyOfAReplay) {
  Report report;
  report.object_file = "<cube>.obj";
  report.friction_angle = Radians(20);
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>&lt;cube&gt;.obj, a solid</dd>"));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>20.00° (μ = 0.364)</dd>"));
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Grasp force")));
  report.settings.emplace().grasp_force_N = 25;
  report.settings->mass_kg = 2.5 / sim::kGravity;
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dt>Grasp force</dt><dd>25 N, 10 × weight; see "));
}

TEST(FactsTest, TheWeakestStepIsNamedWithWhatItHasToSpare) {
  Report report;
  report.friction_angle = Radians(20);
  for (const double required_deg : {12.0, 17.0}) {
    ReportStep& step = report.steps.emplace_back();
    step.check.index = plan::EntryIndex(static_cast<int>(report.steps.size()) - 1);
    step.check.required =
        grasp::RequiredFrictionAngle{Radians(required_deg), Radians(required_deg)};
  }
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>step 1, 3.00° margin</dd>"));
  // If a step failed, the margin of another step is not reported as the weakest.
  report.steps.emplace_back().check.reason = plan::Reason::kNotForceClosure;
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("° margin")));
}

TEST(FactsTest, TheProgramAndTheCommandAreTold) {
  Report report;
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Command")));
  report.run = RunRecord{"", {}, "validate 1.2", "validate --object <cube>.obj"};
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Validated on")));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>validate 1.2</dd>"));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>validate --object &lt;cube&gt;.obj</dd>"));
  report.run->date = "2026-02-28";
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dt>Validated on</dt><dd>2026-02-28 (UTC)</dd>"));
}

}  // namespace facts_test

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
  return Element("main", {}, MakeDisagreements(report), MakeFindings(report)).Format();
}

TEST(FindingsTest, EveryReplayedStepHasItsWeakestFingerAndItsMargins) {
  const std::string text = FormatFindings(MakeReport());
  EXPECT_THAT(text,
              HasSubstr("<td class=\"number\">finger 3</td><td class=\"number\">12.00°</td>"));
  EXPECT_THAT(text, HasSubstr("4.50° (finger 2)"));
  EXPECT_THAT(text, HasSubstr("1.25° (finger 0)"));
  EXPECT_THAT(text, Not(HasSubstr("Disagreements")));
  EXPECT_THAT(text, Not(HasSubstr("Largest disturbance")));
  EXPECT_THAT(text, Not(HasSubstr("Fixed grasp force")));
}

TEST(FindingsTest, AMarginAtTheLimitIsZeroWithoutASign) {
  Report report = MakeReport();
  for (ReportStep& step : report.steps) step.replay->static_margins[FingerIndex(2)] = -1e-7;
  EXPECT_THAT(FormatFindings(report), HasSubstr(">0.00° (finger 2)"));
  for (ReportStep& step : report.steps) {
    step.replay->static_margins[FingerIndex(2)] = Radians(-0.02);
  }
  EXPECT_THAT(FormatFindings(report), HasSubstr(">-0.02° (finger 2)"));
}

TEST(FindingsTest, FingersOfAHandHaveTheirNames) {
  const std::vector<std::string> names = {"<index>", "middle", "ring", "thumb"};
  const std::string text = Element("main", {}, MakeFindings(MakeReport(), names)).Format();
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">thumb</td>"));
  EXPECT_THAT(text, HasSubstr("4.50° (ring)"));
  EXPECT_THAT(text, HasSubstr("1.25° (&lt;index&gt;)"));
  EXPECT_THAT(text, Not(HasSubstr("finger 3")));
}

TEST(FindingsTest, ColumnsWithoutAValueAreOmitted) {
  Report report = MakeReport();
  EXPECT_THAT(FormatFindings(report), HasSubstr("Least force margin, disturbances"));
  for (ReportStep& step : report.steps) step.replay->disturbance_margins.clear();
  EXPECT_THAT(FormatFindings(report), Not(HasSubstr("Least force margin, disturbances")));
  EXPECT_THAT(FormatFindings(report), HasSubstr("Least force margin, static grasp"));
  EXPECT_THAT(FormatFindings(report), HasSubstr("Force margin: "));
  for (ReportStep& step : report.steps) step.replay->static_margins.clear();
  EXPECT_THAT(FormatFindings(report), HasSubstr("Required alone"));
  EXPECT_THAT(FormatFindings(report), Not(HasSubstr("orce margin")));
  for (ReportStep& step : report.steps) step.weakest_finger.reset();
  EXPECT_EQ(FormatFindings(report), "<main></main>");
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
  EXPECT_THAT(FormatFindings(report), Not(HasSubstr("<svg"))) << "one entry is not a plot";
}

}  // namespace findings_test

namespace condition_section_test {

using testing::HasSubstr;

std::string SectionOf(const Report& report) {
  std::string text;
  for (const Element& element : MakeConditionSection(report)) text += element.Format();
  return text;
}

TEST(ConditionSectionTest, EachConditionHasABarAndARow) {
  Report report;
  EXPECT_EQ(SectionOf(report), "");
  sim::ConditionSummary& summary = report.conditions.emplace();
  summary.results.resize(3);
  summary.results[0].condition = {"a&b", R"({"mass_factor":0.5})"};
  summary.results[0].margin = 0.5;
  summary.results[1].condition.name = "icy";
  summary.results[1].reason = plan::Reason::kSlipped;
  summary.results[1].margin = -100;
  summary.results[2].condition.name = "torsion";
  summary.results[2].reason = plan::Reason::kSlipped;
  summary.results[2].ends_within = true;
  const std::string text = SectionOf(report);
  EXPECT_THAT(text, HasSubstr("class=\"bar pass\""));
  EXPECT_THAT(text, HasSubstr("class=\"bar fail\""));
  EXPECT_THAT(text, HasSubstr("class=\"bar partly\""));
  EXPECT_THAT(text, HasSubstr("a&amp;b"));
  EXPECT_THAT(text, HasSubstr("<td>mass_factor 0.5</td>"));
  EXPECT_THAT(text, HasSubstr(">icy</td><td>fail: slipped</td>"));
  // The first bar has half of the length at the limit. A bar has a largest length.
  EXPECT_THAT(text, HasSubstr("width=\"120\""));
  EXPECT_THAT(text, HasSubstr("width=\"432\""));
  EXPECT_THAT(text, HasSubstr("1 of 3 pass, 1 of 3 end within the tolerance"));
}

}  // namespace condition_section_test
}  // namespace regrasp::report
